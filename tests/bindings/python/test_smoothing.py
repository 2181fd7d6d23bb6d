"""Curvature and smoothing of meshes, mollification of fields."""

import os
import tempfile
import unittest

import numpy as np
from support import same_bits

import difmesh

CENTRE, RADIUS, CELLS = (12.1, 11.8, 12.3), 8.0, 24


def ball(**options):
    shape = difmesh.Shape("sphere", radius=RADIUS, centre=CENTRE)
    return difmesh.reconstruct(difmesh.fractions_from_shape(shape, CELLS), **options)


def radii(mesh):
    return np.linalg.norm(mesh.points - CENTRE, axis=1)


class Curvature(unittest.TestCase):
    def test_a_ball(self):
        found = difmesh.curvature(ball())
        for array, wanted in (
            (found.mean, 1 / RADIUS),
            (found.gaussian, 1 / RADIUS**2),
            (found.largest, 1 / RADIUS),
            (found.smallest, 1 / RADIUS),
        ):
            self.assertLess(np.abs(array / wanted - 1).max(), 0.2)
        np.testing.assert_allclose(found.mean, (found.largest + found.smallest) / 2, rtol=1e-12)
        np.testing.assert_allclose(found.gaussian, found.largest * found.smallest, rtol=1e-12)
        self.assertTrue((found.largest >= found.smallest).all())

    def test_a_bubble_is_hollow(self):
        mesh = ball()
        turned = difmesh.Mesh(mesh.points, mesh.faces[:, ::-1])
        np.testing.assert_allclose(
            difmesh.curvature(turned).mean, -difmesh.curvature(mesh).mean, rtol=1e-9
        )

    def test_no_curvature_is_nan(self):
        mesh = difmesh.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        self.assertTrue(np.isnan(difmesh.curvature(mesh).mean).all())

    def test_rings_and_threads(self):
        mesh = ball()
        two = difmesh.curvature(mesh)
        self.assertTrue((difmesh.curvature(mesh, threads=1).mean == two.mean).all())
        self.assertFalse((difmesh.curvature(mesh, rings=3).mean == two.mean).all())
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "rings"):
            difmesh.curvature(mesh, rings=0)
        with self.assertRaises(TypeError):
            difmesh.curvature(mesh.points)
        with self.assertRaises(difmesh.CancelledError):
            difmesh.curvature(mesh, progress=lambda share: False)

    @unittest.skipUnless(difmesh.has("files"), "the library was built without files")
    def test_goes_into_files(self):
        mesh = ball()
        mean = difmesh.curvature(mesh).mean
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "ball.ply")
            mesh.save(path, scalars={"mean_curvature": mean})
            self.assertTrue((difmesh.read_mesh(path).scalars["mean_curvature"] == mean).all())


def facet_means(mesh):
    """Unit sums of the area vectors of the faces around each point."""
    a, b, c = (mesh.points[mesh.faces[:, corner]] for corner in range(3))
    sums = np.zeros_like(mesh.points)
    for corner in range(3):
        np.add.at(sums, mesh.faces[:, corner], np.cross(b - a, c - a))
    return sums / np.linalg.norm(sums, axis=1)[:, np.newaxis]


class Smooth(unittest.TestCase):
    def test_kinds(self):
        mesh = ball(placement="linear", edge_ids=True, vertex_normals=True)
        rough = radii(mesh).std()
        taubin = difmesh.smooth(mesh)
        self.assertLess(radii(taubin).std(), 0.7 * rough)
        self.assertLess(abs(radii(taubin).mean() / radii(mesh).mean() - 1), 0.005)
        self.assertLess(radii(difmesh.smooth(mesh, "laplacian", steps=5)).mean(), RADIUS - 0.1)
        flow = radii(difmesh.smooth(mesh, "flow", time=2.0)).mean()
        self.assertAlmostEqual(flow, np.sqrt(RADIUS**2 - 8), delta=0.05)
        for other in (taubin, difmesh.smooth(mesh, "laplacian", factor=0.5)):
            self.assertTrue((other.faces == mesh.faces).all())
            self.assertTrue((other.edge_ids == mesh.edge_ids).all())
            np.testing.assert_allclose(other.normals, facet_means(other), atol=1e-12)
            self.assertIsNone(other.report)
        bare = difmesh.Mesh(mesh.points, mesh.faces)
        self.assertIsNone(difmesh.smooth(bare).normals)

    def test_constrained(self):
        mesh = ball(placement="linear", edge_ids=True)
        smooth = difmesh.smooth(mesh, "constrained", dims=CELLS, tolerance=0.02)
        before = difmesh.fractions_from_mesh(mesh, CELLS).fractions
        after = difmesh.fractions_from_mesh(smooth, CELLS).fractions
        self.assertGreater(np.abs(after - before).max(), 0)
        self.assertLessEqual(np.abs(after - before).max(), 0.02)
        errors = [np.abs(RADIUS * difmesh.curvature(m).mean - 1).mean() for m in (mesh, smooth)]
        self.assertLess(errors[1], errors[0])
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "grid"):
            difmesh.smooth(mesh, "constrained")

    def test_options_reach_the_library(self):
        mesh = ball(placement="linear")
        usual = difmesh.smooth(mesh)
        self.assertTrue(same_bits(difmesh.smooth(mesh, "taubin", steps=15, threads=1), usual))
        for options in ({"steps": 3}, {"factor": 0.5}, {"pass_band": 0.2}):
            self.assertFalse(same_bits(difmesh.smooth(mesh, **options), usual), options)
        flow = difmesh.smooth(mesh, "flow")
        self.assertFalse(same_bits(difmesh.smooth(mesh, "flow", residual=0.05), flow))
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "1e-14 to 0.1"):
            difmesh.smooth(mesh, "flow", residual=1.0)
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "clearance"):
            difmesh.smooth(ball(edge_ids=True), "constrained", dims=CELLS, clearance=1.0)
        sheet = difmesh.Mesh(
            [[x, y, 0.1 * x * y + 0.3 * x * x * (y == 0)] for y in range(4) for x in range(4)],
            [[i, i + 1, i + 5] for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)]
            + [[i, i + 5, i + 4] for i in (0, 1, 2, 4, 5, 6, 8, 9, 10)],
        )
        self.assertFalse(same_bits(difmesh.smooth(sheet), difmesh.smooth(sheet, boundary="along")))

    def test_bad_arguments(self):
        mesh = ball()
        with self.assertRaisesRegex(ValueError, "'taubin'"):
            difmesh.smooth(mesh, "sand")
        with self.assertRaisesRegex(ValueError, "'along'"):
            difmesh.smooth(mesh, boundary="free")
        with self.assertRaises(ValueError):
            difmesh.smooth(mesh, steps=0)
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "time"):
            difmesh.smooth(mesh, "flow", time=-1.0)
        with self.assertRaises(TypeError):
            difmesh.smooth(mesh.points)


class Mollify(unittest.TestCase):
    def setUp(self):
        self.fractions = np.random.default_rng(4).random((7, 8, 9))

    def test_keeps_the_sum_and_the_place(self):
        field = difmesh.Field(self.fractions, (1.0, 2.0, 3.0), (4.0, 5.0, 6.0))
        smooth = difmesh.mollify(field, radius=3)
        self.assertAlmostEqual(smooth.fractions.sum(), self.fractions.sum(), places=10)
        self.assertLess(smooth.fractions.std(), 0.5 * self.fractions.std())
        self.assertEqual((smooth.spacing, smooth.origin), (field.spacing, field.origin))

    def test_any_layout(self):
        wanted = difmesh.mollify(self.fractions).fractions
        turned = np.asfortranarray(self.fractions)
        self.assertTrue((difmesh.mollify(turned).fractions == wanted).all())
        swapped = self.fractions.transpose(2, 1, 0)
        self.assertTrue((difmesh.mollify(swapped, axes="ijk").fractions == wanted).all())

    def test_sides(self):
        usual = difmesh.mollify(self.fractions).fractions
        mirrored = difmesh.mollify(self.fractions, boundary="mirror").fractions
        self.assertTrue((mirrored == usual).all())
        for sides in ("periodic", "empty", ("full", *("open",) * 5)):
            other = difmesh.mollify(self.fractions, boundary=sides).fractions
            self.assertFalse((other == usual).all(), sides)
            self.assertTrue((other[2:-2, 2:-2, 2:-2] == usual[2:-2, 2:-2, 2:-2]).all())

    def test_bad_arguments(self):
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "radius"):
            difmesh.mollify(self.fractions, radius=9)
        self.fractions[1, 2, 3] = np.nan
        with self.assertRaisesRegex(difmesh.InvalidValueError, r"\(3, 2, 1\)"):
            difmesh.mollify(self.fractions)


if __name__ == "__main__":
    unittest.main()
