"""Fields that are made and files of fields, planes and normals: against closed forms and NumPy."""

import math
import os
import tempfile
import unittest

import numpy as np
from support import same_bits, smooth_ball

import difmesh


class Samples(unittest.TestCase):
    def test_a_function(self):
        """Half-space n.x < d: each cell's fraction by plane_fraction()."""
        normal, d = np.array([0.3, -0.5, 0.81]), 0.7
        calls = []

        def function(points):
            calls.append(len(points))
            self.assertEqual(points.shape[1:], (3,))
            return points @ normal - d

        spacing, origin = (0.5, 0.25, 0.4), (-1, 0, 0.2)
        field = difmesh.fractions_from_function(
            function, (7, 8, 5), spacing, origin, gradient=lambda points: 0 * points + normal
        )
        self.assertEqual(field.fractions.shape, (5, 8, 7))
        self.assertEqual((field.spacing, field.origin), (spacing, origin))
        k, j, i = np.indices((5, 8, 7))
        centres = (np.stack([i, j, k], axis=-1) + 0.5) * spacing + origin
        expected = difmesh.plane_fraction(normal, d - centres @ normal, spacing)
        np.testing.assert_allclose(field.fractions, expected, rtol=0, atol=1e-10)
        self.assertEqual(sum(calls), field.report.function_calls)
        self.assertEqual(field.report.unresolved_cells, 0)

    def test_a_function_on_several_threads(self):
        def function(points):
            return np.linalg.norm(points - 4.1, axis=1) - 2.7

        one = difmesh.fractions_from_function(function, 8)
        many = difmesh.fractions_from_function(function, 8, threads=4)
        self.assertEqual(one.fractions.tobytes(), many.fractions.tobytes())

    def test_points_may_be_kept(self):
        kept = []

        def function(points):
            kept.append((points, points.copy()))
            return points[:, 0] - 1.5

        difmesh.fractions_from_function(function, 4)
        for points, copy in kept:
            np.testing.assert_array_equal(points, copy)

    def test_shapes(self):
        for kind, parameters, volume in (
            ("sphere", {"radius": 3}, 36 * math.pi),
            ("ellipsoid", {"semi_axes": (3, 2, 1.5)}, 12 * math.pi),
            ("torus", {"radius": 3, "tube_radius": 1}, 6 * math.pi**2),
        ):
            shape = difmesh.Shape(kind, centre=5, rotation_degrees=(20, 30, 40), **parameters)
            self.assertAlmostEqual(shape.volume, volume, places=10)
            field = difmesh.fractions_from_shape(shape, 40, 0.25)
            self.assertAlmostEqual(field.report.fraction_volume, volume, places=6)
            self.assertAlmostEqual(field.fractions.sum() / 64, volume, places=6)
        np.testing.assert_allclose(
            difmesh.Shape("sphere", centre=(1, 2, 3)).distances([[1, 2, 3], [1, 4, 3]]), [-1, 1]
        )
        self.assertEqual(
            difmesh.Shape("sphere", centre=(1, 2, 3)).bounds, ((0, 1, 2), (2, 3, 4))
        )

    def test_a_mesh(self):
        """A box, clipped in closed form."""
        corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
        faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                 [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]  # fmt: skip
        low, high = np.array([0.7, 1.2, 0.9]), np.array([3.1, 2.8, 4.25])
        box = difmesh.Mesh(low + corners * (high - low), faces)
        field = difmesh.fractions_from_mesh(box, (4, 5, 6))
        shares = [
            np.clip(np.minimum(high[a], np.arange(n) + 1) - np.maximum(low[a], np.arange(n)), 0, 1)
            for a, n in enumerate((4, 5, 6))
        ]
        expected = np.einsum("i,j,k->kji", *shares)
        np.testing.assert_allclose(field.fractions, expected, rtol=0, atol=1e-14)
        self.assertAlmostEqual(field.report.mesh_volume, np.prod(high - low), places=12)
        inside_out = difmesh.Mesh(box.points, box.faces[:, ::-1])
        with self.assertRaises(difmesh.InvalidArgumentError):
            difmesh.fractions_from_mesh(inside_out, (4, 5, 6))
        again = difmesh.fractions_from_mesh(inside_out, (4, 5, 6), flip=True)
        np.testing.assert_allclose(again.fractions, expected, rtol=0, atol=1e-14)
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "edge"):
            difmesh.fractions_from_mesh(difmesh.Mesh(box.points, box.faces[:-1]), (4, 5, 6))

    def test_overlapping_parts(self):
        """Two plates, [0,1]² x [0,0.02] and [0,1]² x [0.015,0.035], within one layer of cells."""
        corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)])
        faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4],
                 [2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]]  # fmt: skip
        plate = corners * (1, 1, 0.02)
        mesh = difmesh.Mesh(
            np.concatenate([plate, plate + (0, 0, 0.015)]),
            np.concatenate([faces, np.array(faces) + 8]),
        )
        field = difmesh.fractions_from_mesh(mesh, 6, 0.25, -0.25)
        report = field.report
        self.assertAlmostEqual(report.fraction_volume, 0.035, places=14)
        self.assertAlmostEqual(report.overlap_volume, 0.005, places=14)
        self.assertEqual(report.overlap_cells, 16)
        self.assertAlmostEqual(report.largest_overlap, 0.02, places=12)
        self.assertEqual(report.overlap_cell[2], 1)
        np.testing.assert_allclose(report.overlap_low, (0, 0, 0), atol=1e-14)
        np.testing.assert_allclose(report.overlap_high, (1, 1, 0.25), atol=1e-14)
        self.assertEqual((report.inverted_volume, report.inverted_cells), (0, 0))
        self.assertEqual((report.undecided_volume, report.undecided_cells), (0, 0))
        self.assertEqual((report.largest_undecided, report.undecided_cell), (0, (0, 0, 0)))
        united = difmesh.fractions_from_mesh(mesh, 6, 0.25, -0.25, overlaps="union")
        np.testing.assert_array_equal(united.fractions, field.fractions)
        counted = difmesh.fractions_from_mesh(mesh, 6, 0.25, -0.25, overlaps="count")
        self.assertAlmostEqual(counted.report.fraction_volume, 0.04, places=14)
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, r"overlap: cell \(1, 1, 1\)"):
            difmesh.fractions_from_mesh(mesh, 6, 0.25, -0.25, overlaps="refuse")
        with self.assertRaisesRegex(ValueError, "overlaps is 'both'"):
            difmesh.fractions_from_mesh(mesh, 6, 0.25, -0.25, overlaps="both")

    def test_bad_arguments(self):
        shape = difmesh.Shape()
        for exception, call in (
            (ValueError, lambda: difmesh.fractions_from_shape(shape, (4, 4))),
            (ValueError, lambda: difmesh.fractions_from_shape(shape, 4.0)),
            (difmesh.InvalidGridError, lambda: difmesh.fractions_from_shape(shape, 0)),
            (difmesh.InvalidGridError, lambda: difmesh.fractions_from_shape(shape, -3)),
            (ValueError, lambda: difmesh.fractions_from_shape(shape, 2**62)),
            (difmesh.Error, lambda: difmesh.fractions_from_shape(shape, 2**40)),
            (difmesh.InvalidGridError, lambda: difmesh.fractions_from_shape(shape, 4, math.inf)),
            (ValueError, lambda: difmesh.fractions_from_shape(shape, 4, tolerance=1)),
            (TypeError, lambda: difmesh.fractions_from_shape("sphere", 4)),
            (TypeError, lambda: difmesh.fractions_from_mesh(shape, 4)),
            (TypeError, lambda: difmesh.fractions_from_function(3, 4)),
            (ValueError, lambda: difmesh.Shape("soap")),
            (ValueError, lambda: difmesh.Shape("torus", radius=1, tube_radius=2)),
            (TypeError, lambda: difmesh.Shape("sphere", diameter=1)),
        ):
            with self.assertRaises(exception):
                call()


class Planes(unittest.TestCase):
    def test_fraction_and_offset_are_inverse(self):
        random = np.random.default_rng(5)
        normals = random.normal(size=(4, 50, 3))
        fractions = random.random((4, 50))
        spacing = (0.5, 1, 2)
        offsets = difmesh.plane_offset(normals, fractions, spacing)
        self.assertEqual(offsets.shape, (4, 50))
        back = difmesh.plane_fraction(normals, offsets, spacing)
        np.testing.assert_allclose(back, fractions, rtol=0, atol=1e-13)

    def test_closed_forms(self):
        self.assertEqual(difmesh.plane_fraction((0, 0, 2), 0.5), 0.75)  # 2 z <= 1/2
        self.assertAlmostEqual(float(difmesh.plane_offset((1, 1, 1), 1 / 48)), -1.0, places=14)
        offsets = difmesh.plane_offset([1, 0, 0], [0, 0.25, 1, 7], spacing=(4, 1, 1))
        np.testing.assert_allclose(offsets, [-2, -1, 2, 2], atol=1e-15)

    def test_bad_planes(self):
        for exception, arguments in (
            (ValueError, ((1, 1), 0.5)),
            (ValueError, (np.ones((4, 3)), np.ones(5))),
            (difmesh.InvalidArgumentError, ((0, 0, 0), 0.5)),
            (difmesh.InvalidArgumentError, ((1, 0, math.inf), 0.5)),
            (difmesh.InvalidArgumentError, ((1, 0, 0), math.nan)),
            (difmesh.InvalidGridError, ((1, 0, 0), 0.5, 0)),
        ):
            with self.assertRaises(exception):
                difmesh.plane_offset(*arguments)

    def test_planes_of_cells(self):
        """A plane's cells have its normal and offset."""
        normal = np.array([0.36, -0.48, 0.8])
        field = difmesh.fractions_from_function(lambda x: x @ normal - 3.3, (8, 9, 10), 1.0)
        planes = difmesh.normals(field)
        self.assertEqual(planes.normals.shape, (10, 9, 8, 3))
        self.assertEqual((planes.offsets.dtype, planes.sources.dtype), (np.float64, np.int32))
        interfacial = (field.fractions > 1e-6) & (field.fractions < 1 - 1e-6)
        np.testing.assert_array_equal(planes.sources != 0, interfacial)
        np.testing.assert_array_equal(planes.normals[~interfacial], 0)
        inner = interfacial.copy()
        inner[[0, 1, -1, -2]] = inner[:, [0, 1, -1, -2]] = inner[:, :, [0, 1, -1, -2]] = False
        self.assertGreater(inner.sum(), 10)
        np.testing.assert_allclose(
            planes.normals[inner] - normal, np.zeros((inner.sum(), 3)), atol=1e-9
        )
        centres = np.argwhere(inner)[:, ::-1] + 0.5
        np.testing.assert_allclose(planes.offsets[inner], 3.3 - centres @ normal, atol=1e-8)
        # The same cells alone, and with the axes the other way round.
        cells = np.argwhere(interfacial)[:, ::-1]
        alone = difmesh.cell_planes(field, cells)
        self.assertEqual(alone.normals.tobytes(), planes.normals[interfacial].tobytes())
        self.assertEqual(alone.offsets.tobytes(), planes.offsets[interfacial].tobytes())
        self.assertEqual(alone.sources.tobytes(), planes.sources[interfacial].tobytes())
        turned = difmesh.normals(field.fractions.T, axes="ijk")
        np.testing.assert_array_equal(turned.normals, planes.normals.transpose(2, 1, 0, 3))
        np.testing.assert_array_equal(turned.offsets, planes.offsets.T)
        np.testing.assert_array_equal(turned.sources, planes.sources.T)
        self.assertEqual(planes.normals[..., 0].strides, field.fractions.strides)
        youngs = difmesh.normals(field, normals="youngs", boundary="mirror", threads=1)
        self.assertEqual(set(np.unique(youngs.sources)), {0, 1})

    def test_bad_cells(self):
        field = smooth_ball(6, 6, 6)
        for exception, cells in (
            (ValueError, [1, 2, 3]),
            (ValueError, [[1.0, 2, 3]]),
            (difmesh.InvalidArgumentError, [[1, 2, 6]]),
            (difmesh.InvalidArgumentError, [[-1, 2, 3]]),
        ):
            with self.assertRaises(exception):
                difmesh.cell_planes(field, cells)
        empty = difmesh.cell_planes(field, np.empty((0, 3), int))
        self.assertEqual(empty.normals.shape, (0, 3))
        with self.assertRaises(difmesh.InvalidValueError):
            difmesh.normals(np.full((4, 4, 4), np.nan))


@unittest.skipUnless(difmesh.has("files"), "the library was built without files")
class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_npy(self):
        """Against NumPy's own reader and writer, in both orders."""
        values = smooth_ball()
        for array in (values, np.asfortranarray(values), values.astype(">f4")):
            np.save(self.path("a.npy"), array)
            field = difmesh.read_field(self.path("a.npy"))
            np.testing.assert_array_equal(field.fractions, array)
            self.assertFalse(field.fractions.flags.writeable)
            self.assertEqual((field.spacing, field.origin), ((1, 1, 1), (0, 0, 0)))
            self.assertTrue(
                same_bits(difmesh.reconstruct(field), difmesh.reconstruct(array.astype("f8")))
            )
        difmesh.write_field(self.path("b.npy"), values[::-1, :, ::2])
        np.testing.assert_array_equal(np.load(self.path("b.npy")), values[::-1, :, ::2])
        difmesh.write_field(self.path("b.npy"), values.T, axes="ijk", dtype=np.float32)
        np.testing.assert_array_equal(np.load(self.path("b.npy")), values.astype(np.float32))

    def test_nrrd_keeps_spacing_and_origin(self):
        values = np.rint(smooth_ball() * 65535).astype(np.uint16)
        for options in ({}, {"gzip": False}, {"gzip_level": 9}):
            difmesh.write_field(
                self.path("a.nrrd"), values, spacing=(0.5, 1, 2), origin=(-3, 4, 5), **options
            )
            field = difmesh.read_field(self.path("a.nrrd"))
            np.testing.assert_array_equal(field.fractions, values)
            self.assertEqual((field.spacing, field.origin), ((0.5, 1, 2), (-3, 4, 5)))
            self.assertEqual(np.asarray(field).dtype, np.uint16)
        difmesh.write_field(self.path("b.nrrd"), field)
        self.assertEqual(difmesh.read_field(self.path("b.nrrd")).spacing, (0.5, 1, 2))
        self.assertEqual(repr(field), "Field(24 x 19 x 21 cells of uint16)")
        with self.assertRaises(ValueError):
            difmesh.reconstruct(field, axes="ijk")

    def test_raw(self):
        values = smooth_ball().astype(">f4")
        with open(self.path("a.raw"), "wb") as file:
            file.write(b"header" + values.tobytes())
        field = difmesh.read_field(self.path("a.raw"), dims=(24, 19, 21), dtype=">f4", offset=6)
        np.testing.assert_array_equal(field.fractions, values)
        with self.assertRaises(difmesh.FileFormatError):
            difmesh.read_field(self.path("a.raw"), dims=(24, 19, 22), dtype=">f4", offset=6)
        with self.assertRaises(ValueError):
            difmesh.read_field(self.path("a.raw"), dims=(24, 19, 21), dtype=np.int64)

    def test_fractions_keep_the_memory_of_the_file(self):
        np.save(self.path("a.npy"), smooth_ball())
        fractions = difmesh.read_field(self.path("a.npy")).fractions
        for _ in range(10):
            difmesh.read_field(self.path("a.npy"))
        np.testing.assert_array_equal(fractions, smooth_ball())

    def test_what_fails(self):
        with self.assertRaises(difmesh.FileMissingError):
            difmesh.read_field(self.path("none.npy"))
        with self.assertRaises(difmesh.InvalidArgumentError):
            difmesh.write_field(self.path("a.soap"), smooth_ball())
        with self.assertRaises(difmesh.FileWriteError):
            difmesh.write_field(self.path("no/a.npy"), smooth_ball())
        self.assertEqual(os.listdir(self.folder), [])



class Stretched(unittest.TestCase):
    """Grids whose axes are tables of faces."""

    def setUp(self):
        steps = 1.0 + 0.2 * np.sin(np.arange(24))
        faces = np.concatenate(([0.0], np.cumsum(steps)))
        self.edges = tuple(scale * (faces / faces[-1]) - 0.5 * scale for scale in (3.0, 3.2, 3.4))

    def test_a_ball(self):
        shape = difmesh.Shape("sphere", radius=1.2)
        field = difmesh.fractions_from_shape(shape, 24, edges=self.edges)
        ball = 4 / 3 * np.pi * 1.2**3
        self.assertAlmostEqual(field.report.fraction_volume, ball, places=8)
        mesh = difmesh.reconstruct(field)
        self.assertTrue(mesh.report.closed)
        self.assertAlmostEqual(mesh.report.fraction_volume, ball, places=8)
        radii = np.linalg.norm(mesh.points, axis=1)
        self.assertLess(np.abs(radii - 1.2).max(), 0.01)
        again = difmesh.reconstruct(field.fractions, edges=[list(e) for e in self.edges])
        self.assertTrue((again.points == mesh.points).all())
        planes = difmesh.normals(field)
        cells = np.argwhere((field.fractions > 0.1) & (field.fractions < 0.9))
        for k, j, i in cells[::37]:
            centre = [0.5 * (e[n] + e[n + 1]) for e, n in zip(self.edges, (i, j, k))]
            self.assertGreater(planes.normals[k, j, i] @ centre / np.linalg.norm(centre), 0.99)

    def test_one_axis(self):
        field = np.zeros((3, 4, 5))
        field[:2] = 1.0
        field[1] = 0.5
        mesh = difmesh.reconstruct(field, spacing=2.0, edges=(None, None, [0.0, 1.0, 4.0, 5.0]))
        self.assertTrue(np.abs(mesh.points[:, 2] - 2.5).max() < 1e-11)

    def test_bad_tables(self):
        field = np.full((3, 3, 3), 0.5)
        for edges in ((1, 2), ([0, 1, 2], None, None), (None, [[0, 1, 2, 3]], None)):
            with self.subTest(edges=edges), self.assertRaises(ValueError):
                difmesh.reconstruct(field, edges=edges)
        with self.assertRaisesRegex(difmesh.InvalidGridError, "faces in z: number 2"):
            difmesh.reconstruct(field, edges=(None, None, [0, 1, 1, 2]))
        good = np.arange(4.0)
        masked = np.ma.masked_array(good, mask=[0, 1, 0, 0])
        for table in (good.astype(complex), np.array(list("0123")), masked, good.astype(object)):
            with self.subTest(table=table), self.assertRaisesRegex(TypeError, "edges in y"):
                difmesh.reconstruct(field, edges=(None, table, None))
        for beside in ({"spacing": 2.0}, {"origin": (1, 2, 3)}):
            with self.subTest(beside=beside), self.assertRaisesRegex(ValueError, "beside edges"):
                difmesh.reconstruct(field, edges=(good, good, good), **beside)
            with self.subTest(beside=beside), self.assertRaisesRegex(ValueError, "beside edges"):
                difmesh.fractions_from_shape(
                    difmesh.Shape("sphere"), 3, edges=(good, good, good), **beside
                )
        # The one axis left takes them.
        mesh = difmesh.reconstruct(field, spacing=2.0, origin=1.0, edges=(good, good, None))
        self.assertEqual(mesh.report.fraction_volume, 27.0)


if __name__ == "__main__":
    unittest.main()
