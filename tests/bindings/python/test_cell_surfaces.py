"""Curved surfaces of cells and their curvature, against spheres."""

import math
import unittest

import numpy as np
from support import smooth_ball

import difmesh

SPACING, ORIGIN, RADIUS = 0.2, (-2.47, -2.54, -2.63), 2.0
DIMS = (26, 27, 28)


def sphere():
    """Fractions of a drop, ten cells per radius, [k, j, i]."""
    shape = difmesh.Shape("sphere", radius=RADIUS)
    return difmesh.fractions_from_shape(shape, DIMS, SPACING, ORIGIN)


def is_interfacial(fractions):
    return (fractions > 1e-6) & (fractions < 1 - 1e-6)


class CellCurvature(unittest.TestCase):
    def test_of_drops_and_bubbles(self):
        field = sphere()
        interfacial = is_interfacial(field.fractions)
        self.assertGreater(interfacial.sum(), 1000)
        for fractions, expected in ((field.fractions, 0.5), (1 - field.fractions, -0.5)):
            mean = difmesh.cell_curvature(fractions, spacing=SPACING)
            self.assertEqual(mean.shape, fractions.shape)
            self.assertLess(np.abs(mean[interfacial] - expected).max(), 0.02 * 0.5)
            np.testing.assert_array_equal(mean[~interfacial], 0)
        np.testing.assert_array_equal(
            difmesh.cell_curvature(field),
            difmesh.cell_curvature(field.fractions, spacing=SPACING, origin=ORIGIN, threads=1),
        )

    def test_however_the_array_lies(self):
        field = sphere()
        fractions = field.fractions
        mean = difmesh.cell_curvature(field)
        self.assertEqual(mean.strides, np.empty(DIMS[::-1]).strides)
        given = {"spacing": SPACING, "origin": ORIGIN}
        turned = difmesh.cell_curvature(fractions.T, axes="ijk", **given)
        np.testing.assert_array_equal(turned, mean.T)
        wide = np.full((28, 27, 52), 7.0)
        wide[:, :, ::2] = fractions
        for array in (np.asfortranarray(fractions), wide[:, :, ::2]):
            np.testing.assert_array_equal(difmesh.cell_curvature(array, **given), mean)
        x, y, z = (np.arange(n + 1) * SPACING + low for n, low in zip(DIMS, ORIGIN))
        stretched = difmesh.cell_curvature(fractions, edges=(x, y, z))
        np.testing.assert_allclose(stretched, mean, rtol=0, atol=1e-6)

    def test_without_a_surface(self):
        field = np.zeros((5, 6, 7))
        np.testing.assert_array_equal(difmesh.cell_curvature(field), 0)
        field[2, 3, 4] = 0.5
        mean = difmesh.cell_curvature(field)
        self.assertTrue(math.isnan(mean[2, 3, 4]))
        self.assertEqual(np.isnan(mean).sum(), 1)

    def test_bad_arguments(self):
        field = smooth_ball(8, 8, 8)
        for exception, given in (
            (ValueError, {"boundary": "nowhere"}),
            (ValueError, {"axes": "xyz"}),
            (difmesh.InvalidGridError, {"spacing": 0}),
            (difmesh.InvalidArgumentError, {"purity_tolerance": 1}),
        ):
            with self.assertRaises(exception):
                difmesh.cell_curvature(field, **given)
            with self.assertRaises(exception):
                difmesh.cell_surfaces(field, **given)
        for call in (difmesh.cell_curvature, difmesh.cell_surfaces):
            with self.assertRaises(difmesh.InvalidValueError):
                call(np.full((4, 4, 4), np.nan))


class CellSurfaces(unittest.TestCase):
    def test_of_a_sphere(self):
        field = sphere()
        interfacial = is_interfacial(field.fractions)
        mean = difmesh.cell_curvature(field)
        for kind, error in (("curvature", 0.02), ("position", 0.2)):
            surfaces = difmesh.cell_surfaces(field, kind=kind)
            np.testing.assert_array_equal(surfaces.cells, np.argwhere(interfacial)[:, ::-1])
            self.assertTrue((surfaces.source > 0).all())
            # The foot lies on the sphere; the normal is that of the sphere there.
            feet = (surfaces.cells + 0.5) * SPACING + ORIGIN + surfaces.foot
            radii = np.linalg.norm(feet, axis=1)
            self.assertLess(np.abs(radii - RADIUS).max(), 5e-3 * SPACING)
            normals = feet / radii[:, np.newaxis]
            self.assertLess(np.abs(surfaces.normal - normals).max(), 5e-3)
            self.assertLess(np.abs(surfaces.mean * RADIUS - 1).max(), error)
            self.assertLess(np.abs(surfaces.gaussian * RADIUS**2 - 1).max(), 2 * error)
            self.assertTrue((surfaces.largest >= surfaces.smallest).all())
            np.testing.assert_allclose(
                surfaces.largest + surfaces.smallest, 2 * surfaces.mean, rtol=1e-9
            )
            np.testing.assert_allclose(surfaces.length, SPACING)
            self.assertTrue((surfaces.residual <= 0.03).all())
            if kind == "curvature":
                np.testing.assert_array_equal(surfaces.mean, mean[interfacial])

    def test_frame_and_coefficients(self):
        """Where one axis has the right, the graph runs through the foot."""
        surfaces = difmesh.cell_surfaces(sphere(), kind="position")
        np.testing.assert_allclose(
            surfaces.frame @ surfaces.frame.transpose(0, 2, 1),
            np.broadcast_to(np.eye(3), surfaces.frame.shape),
            rtol=0,
            atol=1e-12,
        )
        fits = surfaces.source >= 3
        self.assertGreater(fits.sum(), 10)
        self.assertTrue((surfaces.axis[fits] == -1).all())
        self.assertTrue((surfaces.axis[~fits] >= 0).all())
        foot = np.einsum("nij,nj->ni", surfaces.frame, surfaces.foot) / SPACING
        powers = np.arange(5)
        height = np.einsum(
            "npq,np,nq->n",
            surfaces.coefficients,
            foot[:, :1] ** powers,
            foot[:, 1:2] ** powers,
        )
        self.assertLess(np.abs(height - foot[:, 2])[fits].max(), 1e-3)

    def test_of_some_cells(self):
        field = sphere()
        every = difmesh.cell_surfaces(field)
        chosen = every.cells[::7].astype(np.int32)
        some = difmesh.cell_surfaces(field.fractions.T, chosen, spacing=SPACING, axes="ijk")
        self.assertEqual(some.cells.dtype, np.int64)
        for name in ("source", "axis", "foot", "normal", "mean", "frame", "coefficients"):
            np.testing.assert_array_equal(getattr(some, name), getattr(every, name)[::7])
        none = difmesh.cell_surfaces(field, [[0, 0, 0]])
        self.assertEqual((none.source[0], none.axis[0]), (0, -1))
        self.assertTrue(np.isnan([none.mean, none.gaussian, none.largest, none.smallest]).all())

    def test_of_no_cells(self):
        for surfaces in (
            difmesh.cell_surfaces(np.zeros((4, 5, 6))),
            difmesh.cell_surfaces(smooth_ball(), np.empty((0, 3), int)),
        ):
            self.assertEqual(surfaces.mean.shape, (0,))
            self.assertEqual(surfaces.frame.shape, (0, 3, 3))

    def test_bad_cells_and_kinds(self):
        field = smooth_ball(6, 6, 6)
        for exception, cells in (
            (ValueError, [1, 2, 3]),
            (ValueError, [[1.0, 2, 3]]),
            (difmesh.InvalidArgumentError, [[1, 2, 6]]),
            (difmesh.InvalidArgumentError, [[-1, 2, 3]]),
        ):
            with self.assertRaises(exception):
                difmesh.cell_surfaces(field, cells)
        with self.assertRaises(ValueError):
            difmesh.cell_surfaces(field, kind="area")


if __name__ == "__main__":
    unittest.main()
