"""Meshes: from fields, from arrays, from and to files; measures and distances of them."""

import copy
import dataclasses
import json
import math
import os
import pickle
import tempfile
import unittest
import warnings

import numpy as np
from support import ball_distance, same_bits, smooth_ball

import difmesh

CUBE = (
    [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)],
    [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4], [2, 6, 3], [3, 6, 7],
     [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]],
)  # fmt: skip


class Reconstruct(unittest.TestCase):
    def test_a_ball(self):
        shape = difmesh.Shape("sphere", radius=11.2, centre=(16.1, 15.8, 16.3))
        field = difmesh.fractions_from_shape(shape, 32)
        mesh = difmesh.reconstruct(field, vertex_normals=True, edge_ids=True)
        radii = np.linalg.norm(mesh.points - (16.1, 15.8, 16.3), axis=1)
        self.assertLess(np.abs(radii - 11.2).max(), 0.016)  # table of the README, 8 to 16 cells
        outwards = (mesh.points - (16.1, 15.8, 16.3)) / radii[:, None]
        self.assertGreater((mesh.normals * outwards).sum(axis=1).min(), 0.99)
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1, atol=1e-12)
        self.assertTrue((np.diff(mesh.edge_ids.astype(np.int64)) > 0).all())
        # Every vertex lies on the edge that its name tells.
        axis, code = mesh.edge_ids % 3, mesh.edge_ids // 3
        lower = np.stack([code % 34, code // 34 % 34, code // 34**2], axis=1) - 0.5
        along = mesh.points - lower
        rows = np.arange(len(along))
        self.assertTrue(((along[rows, axis] > 0) & (along[rows, axis] < 1)).all())
        along[rows, axis] = 0
        self.assertEqual(np.abs(along).max(), 0)
        report = mesh.report
        self.assertEqual(report.cells, 32**3)
        self.assertIs(report.closed, True)
        self.assertAlmostEqual(report.fraction_volume, 4 / 3 * math.pi * 11.2**3, places=6)
        self.assertAlmostEqual(report.enclosed_volume, mesh.measure().volume, places=8)
        self.assertEqual(repr(mesh), f"Mesh({len(mesh.points)} points, {len(mesh.faces)} faces)")

    def test_options_reach_the_library(self):
        field = smooth_ball()
        plic = difmesh.reconstruct(field)
        for options in (
            {"placement": "linear"},
            {"placement": "manson"},
            {"placement": "midpoint"},
            {"normals": "youngs"},
            {"normals": "myc"},
            {"purity_tolerance": 0.1},
        ):
            self.assertFalse(same_bits(difmesh.reconstruct(field, **options), plic), options)
        for threads in (1, 2):
            self.assertTrue(same_bits(difmesh.reconstruct(field, threads=threads), plic))
        midpoint = difmesh.reconstruct(field, placement="midpoint").points
        self.assertTrue((np.rint(2 * midpoint) == 2 * midpoint).all())
        half = np.ones((6, 6, 6))
        half[3:] = 0
        self.assertFalse(difmesh.reconstruct(half).report.closed)
        self.assertTrue(difmesh.reconstruct(half, boundary="empty").report.closed)
        # Full below, so the low sides close it except in z.
        sides = ["empty", "empty", "empty", "empty", "mirror", "empty"]
        mesh = difmesh.reconstruct(half, boundary=sides)
        self.assertGreater(mesh.measure().boundary_edges, 0)
        self.assertEqual(mesh.points[:, 2].min(), 0)
        over = np.zeros((4, 4, 4))
        over[1, 1, 1] = 1.2
        with self.assertRaisesRegex(difmesh.InvalidValueError, r"cell \(1, 1, 1\)"):
            difmesh.reconstruct(over)
        mesh = difmesh.reconstruct(over, overshoot_bound=0.5)
        self.assertEqual(mesh.report.clamped_cells, 1)
        self.assertAlmostEqual(mesh.report.largest_overshoot, 0.2)

    def test_bad_options(self):
        field = smooth_ball(6, 6, 6)
        for options in (
            {"placement": "best"},
            {"normals": 3},
            {"boundary": "wall"},
            {"boundary": ["open"] * 5},
            {"purity_tolerance": -1},
            {"purity_tolerance": math.nan},
            {"clearance": 1},
            {"threads": -1},
            {"threads": 2**32},
        ):
            with self.assertRaises(ValueError, msg=options):
                difmesh.reconstruct(field, **options)
        for options in ({"threads": 1.5}, {"purity_tolerance": "low"}):
            with self.assertRaises(TypeError, msg=options):
                difmesh.reconstruct(field, **options)

    def test_blocks_weld_to_the_whole(self):
        plain = self.weld_blocks()
        # Far from the ends of their edges, vertices lie elsewhere.
        self.assertFalse(same_bits(self.weld_blocks(clearance=0.25), plain))
        with self.assertRaises(difmesh.InvalidArgumentError):
            difmesh.weld([difmesh.Mesh(*CUBE)], (11, 12, 13), spacing=0.5, origin=(1, 2, 3))

    def weld_blocks(self, **options):
        """The whole of two blocks, which is that of the field, bit for bit."""
        field = smooth_ball()
        whole = difmesh.reconstruct(field, spacing=0.5, origin=(1, 2, 3), edge_ids=True, **options)
        dims = np.array(field.shape[::-1])
        parts = []
        for low, high in ((0, 11), (11, dims[2])):
            offset, end = np.array([0, 0, low]), np.array([dims[0], dims[1], high])
            ghost_low = np.minimum(offset, difmesh.GHOST_LAYERS)
            ghost_high = np.minimum(dims - end, difmesh.GHOST_LAYERS)
            cut = field[low - ghost_low[2] : high + ghost_high[2]]
            parts.append(
                difmesh.reconstruct_block(
                    cut, grid_dims=dims, offset=offset, dims=end - offset, ghost_low=ghost_low,
                    ghost_high=ghost_high, spacing=0.5, origin=(1, 2, 3), **options,
                )
            )  # fmt: skip
        self.assertTrue(all(len(part.faces) > 100 for part in parts))
        welded = difmesh.weld(parts, dims, spacing=0.5, origin=(1, 2, 3))
        self.assertTrue(same_bits(welded, whole))
        return welded


class Arrays(unittest.TestCase):
    def test_a_cube(self):
        points, faces = CUBE
        mesh = difmesh.Mesh(points, faces)
        np.testing.assert_array_equal(mesh.points, points)
        np.testing.assert_array_equal(mesh.faces, faces)
        self.assertIsNone(mesh.normals)
        self.assertIsNone(mesh.report)
        measure = mesh.measure()
        self.assertEqual(
            (measure.vertices, measure.edges, measure.triangles, measure.euler_number),
            (8, 18, 12, 2),
        )
        self.assertIs(measure.closed, True)
        self.assertIs(measure.manifold, True)
        self.assertEqual((measure.area, measure.volume), (6, 1))
        self.assertEqual((measure.low, measure.high), ((0, 0, 0), (1, 1, 1)))
        self.assertIs(measure.has_volume, True)
        points, faces = map(np.array, CUBE)
        doubled = difmesh.Mesh(points, np.vstack([faces, faces[:1]])).measure()
        self.assertEqual((doubled.closed, doubled.has_volume), (False, False))
        self.assertEqual(doubled.unbalanced_edges, 3)
        split = difmesh.Mesh(points[faces].reshape(-1, 3), np.arange(36).reshape(-1, 3))
        self.assertEqual((split.measure().closed, split.measure().has_volume), (False, True))

    def test_any_layout_is_copied(self):
        points, faces = map(np.array, CUBE)
        wide = np.zeros((8, 6), np.float32)
        wide[:, 1:6:2] = points
        for corners in (faces.astype(np.uint8), np.asfortranarray(faces), faces[:, ::-1][:, ::-1]):
            mesh = difmesh.Mesh(wide[:, 1:6:2], corners)
            np.testing.assert_array_equal(mesh.points, points)
            np.testing.assert_array_equal(mesh.faces, faces)
        wide[:] = 7
        np.testing.assert_array_equal(mesh.points, points)

    def test_normals_and_edge_ids(self):
        points, faces = CUBE
        mesh = difmesh.Mesh(points, faces, np.array(points) - 0.5, range(8))
        np.testing.assert_array_equal(mesh.normals, np.array(points) - 0.5)
        np.testing.assert_array_equal(mesh.edge_ids, range(8))

    def test_no_mesh(self):
        mesh = difmesh.Mesh(np.empty((0, 3)), [])
        self.assertEqual(len(mesh.faces), 0)

    def test_bad_arrays(self):
        points, faces = CUBE
        for bad, exception in (
            ((points, [[0, 1, 8]]), difmesh.InvalidArgumentError),
            ((points, [[0, 1, -1]]), ValueError),
            ((points, [[0, 1, 2**32]]), ValueError),
            ((points, [[0, 1, 2.0]]), TypeError),
            ((points, [0, 1, 2]), ValueError),
            ((np.zeros((8, 2)), faces), ValueError),
            ((points, faces, points[:7]), ValueError),
            ((points, faces, None, range(7)), ValueError),
            ((["a"], faces), ValueError),
        ):
            with self.assertRaises(exception, msg=bad):
                difmesh.Mesh(*bad)

    def test_copies_and_pickles(self):
        mesh = difmesh.reconstruct(smooth_ball(), vertex_normals=True)
        for again in (copy.copy(mesh), copy.deepcopy(mesh), pickle.loads(pickle.dumps(mesh))):
            self.assertTrue(same_bits(mesh, again))
            np.testing.assert_array_equal(mesh.normals, again.normals)
            self.assertFalse(np.shares_memory(mesh.points, again.points))
        with self.assertRaises(TypeError):
            pickle.dumps(difmesh.Shape())


class Distances(unittest.TestCase):
    @unittest.skipUnless(difmesh.has("distance"), "the library was built without distances")
    def test_of_a_larger_ball(self):
        shape = difmesh.Shape("sphere", radius=6.5, centre=(12.3, 9.1, 10.4))
        mesh = difmesh.reconstruct(smooth_ball())
        expected = ball_distance(mesh.points, radius=6.5)
        for reference in (shape, lambda points: ball_distance(points, radius=6.5), shape.distances):
            vertices = difmesh.distance(mesh, reference).vertices
            self.assertEqual(vertices.points, len(mesh.points))
            self.assertAlmostEqual(vertices.signed_mean, expected.mean(), places=12)
            self.assertAlmostEqual(vertices.highest, expected.max(), places=12)
            self.assertEqual(vertices.maximum_index, np.abs(expected).argmax())
            self.assertEqual(
                vertices.maximum_position, tuple(mesh.points[vertices.maximum_index])
            )
        shifted = difmesh.Mesh(mesh.points + (3.0, 0, 0), mesh.faces)
        there, back = difmesh.distance_both_ways(mesh, shifted)
        self.assertIs(there.has_sign, True)
        self.assertGreater(there.vertices.highest, 2)
        self.assertLessEqual(there.vertices.maximum, 3 + 1e-12)
        self.assertAlmostEqual(there.area, back.area, places=9)
        self.assertEqual(difmesh.distance(mesh, shifted).vertices, there.vertices)
        unsigned = difmesh.distance(mesh, shifted, with_sign=False)
        self.assertIs(unsigned.has_sign, False)
        self.assertGreaterEqual(unsigned.vertices.lowest, 0)

    @unittest.skipUnless(difmesh.has("distance"), "the library was built without distances")
    def test_bad_arguments(self):
        mesh = difmesh.Mesh(*CUBE)
        for mesh_, reference, exception in (
            (mesh, 3, TypeError),
            (CUBE, mesh, TypeError),
            (difmesh.Mesh(np.empty((0, 3)), []), mesh, difmesh.InvalidArgumentError),
            (mesh, lambda points: points[:, 0] * np.nan, difmesh.InvalidValueError),
            (mesh, lambda points: {}[0], KeyError),
        ):
            with self.assertRaises(exception):
                difmesh.distance(mesh_, reference)


@unittest.skipUnless(difmesh.has("files"), "the library was built without files")
class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def test_formats(self):
        mesh = difmesh.reconstruct(smooth_ball(), vertex_normals=True, edge_ids=True)
        for extension, digits in (("ply", 17), ("obj", 9), ("off", 9)):
            mesh.save(self.path(f"ball.{extension}"))
            again = difmesh.read_mesh(self.path(f"ball.{extension}"))
            np.testing.assert_allclose(again.points, mesh.points, rtol=10.0**-digits, atol=0)
            np.testing.assert_array_equal(again.faces, mesh.faces)
        mesh.save(self.path("ball.stl").encode())
        with open(self.path("ball.stl"), "rb") as file:
            self.assertEqual(len(file.read()), 84 + 50 * len(mesh.faces))
        mesh.save(self.path("ball.soap"), format="ply", normals=False, edge_ids=False)
        difmesh.reconstruct(smooth_ball()).save(self.path("plain.ply"))
        with open(self.path("ball.soap"), "rb") as one, open(self.path("plain.ply"), "rb") as two:
            self.assertEqual(one.read(), two.read())

    def saved(self, mesh, file, **options):
        report = mesh.save(self.path(file), **options)
        self.assertIsInstance(report, difmesh.WriteReport)
        self.assertEqual(report.bytes, os.path.getsize(self.path(file)))
        return report

    def test_reports_of_tables(self):
        mesh = difmesh.reconstruct(smooth_ball(), spacing=0.1)
        for extension in ("ply", "obj", "off"):
            self.assertEqual(
                dataclasses.replace(self.saved(mesh, f"ball.{extension}"), bytes=0),
                difmesh.WriteReport(
                    bytes=0, vertices=len(mesh.points), triangles=len(mesh.faces), primitives=1,
                    position_bits=0, position_error=0.0, local_origin=(0.0, 0.0, 0.0),
                    collapsed_triangles=0,
                ),
            )  # fmt: skip
        report = self.saved(mesh, "ball.stl")
        self.assertEqual(report.vertices, 3 * len(mesh.faces))
        rounded = mesh.points.astype(np.float32).astype(np.float64)
        self.assertGreater(report.position_error, 0)
        self.assertEqual(report.position_error, np.abs(rounded - mesh.points).max())
        self.assertEqual(report.collapsed_triangles, 0)
        with self.assertRaises(dataclasses.FrozenInstanceError):
            report.bytes = 1

    def test_triangles_collapse_in_stl_far_away(self):
        mesh = difmesh.reconstruct(smooth_ball(), spacing=0.01, origin=(5e5, 5.4e6, 300))
        rounded = mesh.points.astype(np.float32)[mesh.faces]
        edges = (rounded - rounded[:, :1]).astype(np.float64)
        lost = (np.cross(edges[:, 1], edges[:, 2]) == 0).all(axis=1)
        with self.assertWarnsRegex(difmesh.Warning, "far.stl.*triangles collapse") as caught:
            report = self.saved(mesh, "far.stl")
        self.assertEqual(os.path.basename(caught.filename), "test_mesh.py")
        self.assertGreater(report.collapsed_triangles, 100)
        self.assertEqual(report.collapsed_triangles, np.count_nonzero(lost))

    def need(self, *parts):
        for part in parts:
            if not difmesh.has(part):
                self.skipTest(f"skipped: a library without {part}")

    def test_gltf(self):
        """float32 about the mesh's centre."""
        self.need("gltf")
        mesh = difmesh.reconstruct(smooth_ball())
        mesh.save(self.path("ball.glb"))
        with open(self.path("ball.glb"), "rb") as file:
            self.assertEqual(file.read(4), b"glTF")
        again = difmesh.read_mesh(self.path("ball.glb"))
        np.testing.assert_allclose(again.points, mesh.points, rtol=0, atol=1e-6)
        np.testing.assert_array_equal(again.faces, mesh.faces)

    def test_scalars(self):
        self.need("gltf")
        ball = difmesh.reconstruct(smooth_ball())
        self.assertEqual(ball.scalars, {})
        heights = ball.points[:, 2]
        mesh = difmesh.Mesh(ball.points, ball.faces, scalars={"height": heights})
        mesh.save(self.path("ball.glb"), scalars={"Twice": 2 * heights})
        np.testing.assert_array_equal(list(mesh.scalars), ["height"])  # the mesh is as it was
        again = difmesh.read_mesh(self.path("ball.glb")).scalars
        self.assertEqual(list(again), ["height", "twice"])
        np.testing.assert_allclose(again["height"], heights, rtol=1e-6)
        np.testing.assert_allclose(again["twice"], 2 * heights, rtol=1e-6)
        for other in (pickle.loads(pickle.dumps(mesh)), copy.deepcopy(mesh)):
            np.testing.assert_array_equal(other.scalars["height"], heights)
        array = mesh.scalars["height"]
        del mesh, other
        np.testing.assert_array_equal(array, heights)  # it keeps its memory
        with self.assertRaises(ValueError):
            array[0] = 1

    def test_draco(self):
        self.need("gltf", "draco")
        mesh = difmesh.reconstruct(smooth_ball())
        side = np.ptp(mesh.points, axis=0).max()
        sizes = []
        for bits in (8, 14):
            report = self.saved(mesh, "ball.glb", draco=bits, draco_method="sequential")
            again = difmesh.read_mesh(self.path("ball.glb"))
            np.testing.assert_array_equal(again.faces, mesh.faces)
            half_step = side / (2 * (2**bits - 1))
            error = np.abs(again.points - mesh.points).max()
            self.assertLess(error, half_step + 1e-6 * side)
            self.assertGreater(error, half_step / 2)
            self.assertLessEqual(error, report.position_error)
            self.assertGreater(error, report.position_error / 2)
            self.assertEqual(report.position_bits, bits)
            centre = (mesh.points.min(axis=0) + mesh.points.max(axis=0)) / 2
            np.testing.assert_allclose(report.local_origin, centre, rtol=1e-15)
            sizes.append(os.path.getsize(self.path("ball.glb")))
        self.assertLess(sizes[0], sizes[1])
        mesh.save(self.path("ball.glb"), draco=14, draco_speed=0)
        self.assertLess(os.path.getsize(self.path("ball.glb")), sizes[0])
        mesh.save(self.path("ball.drc"), draco=8, cell_size=1.0)
        mesh.save(self.path("fine.drc"), cell_size=0.01)
        self.assertLess(
            os.path.getsize(self.path("ball.drc")), os.path.getsize(self.path("fine.drc"))
        )

    def test_colors(self):
        self.need("gltf")
        mesh = difmesh.reconstruct(smooth_ball())
        report = self.saved(
            mesh, "ball.gltf", scalars={"x": mesh.points[:, 0]}, color_by="x",
            color_map="cool_warm", color_range=(-2.5, 30), up="z", metres_per_unit=0.25,
            local_origin=(0, 0, 3.5), most_vertices=200, name="a ball",
        )  # fmt: skip
        self.assertEqual(report.local_origin, (0.0, 0.0, 3.5))
        self.assertEqual(report.triangles, len(mesh.faces))
        self.assertGreater(report.vertices, len(mesh.points))
        with open(self.path("ball.gltf")) as file:
            document = json.load(file)
        (surface,) = document["meshes"]
        self.assertEqual(surface["name"], "a ball")
        self.assertGreater(len(surface["primitives"]), 2)
        self.assertEqual(len(surface["primitives"]), report.primitives)
        for primitive in surface["primitives"]:
            self.assertTrue({"COLOR_0", "_X"} <= set(primitive["attributes"]))
        text = json.dumps(document)
        for words in ("cool_warm", "-2.5", '"scale": [0.25, 0.25, 0.25]', "[0.0, 0.0, 3.5]"):
            self.assertIn(words, text)

    def test_bad_write_options(self):
        self.need("gltf", "draco")
        mesh = difmesh.Mesh(*CUBE)
        for options in (
            {"draco": 25},
            {"draco": -1},
            {"draco": 0},
            {"draco_method": "best"},
            {"draco": True, "draco_speed": 11},
            {"draco": True, "normal_bits": 2**32 + 10},
            {"color_by": "height"},
            {"color_map": "jet"},
            {"color_range": (0, 0)},
            {"color_range": (1, 2, 3)},
            {"up": "x"},
            {"metres_per_unit": 0},
            {"local_origin": (0, math.nan, 0)},
            {"most_vertices": 2},
            {"name": "a\0b"},
            {"scalars": {"a b": np.zeros(8)}},
            {"scalars": {"": np.zeros(8)}},
            {"scalars": {"a\0b": np.zeros(8)}},
            {"scalars": {"a": np.zeros(7)}},
            {"scalars": {"a": np.full(8, math.nan)}},
            {"scalars": {"a": np.zeros(8), "A": np.zeros(8)}},
        ):
            with self.assertRaises(ValueError, msg=options):
                mesh.save(self.path("cube.glb"), **options)
        for options in ({"draco": True}, {"color_by": "a"}, {"up": "z"}, {"metres_per_unit": 2}):
            with self.assertRaises(difmesh.InvalidArgumentError, msg=options):
                mesh.save(self.path("cube.ply"), **options)
        self.assertEqual(os.listdir(self.folder), [])

    def test_formats_that_are_not_there(self):
        mesh = difmesh.Mesh(*CUBE)
        for part, options in (("gltf", {}), ("draco", {"format": "drc"}), ("draco", {"draco": 9})):
            if not difmesh.has(part):
                message = f"(?i)without {part}|without gltf"
                with self.assertRaisesRegex(difmesh.UnsupportedError, message):
                    mesh.save(self.path("cube.glb"), **options)
        if not difmesh.has("draco"):
            with self.assertRaises(difmesh.UnsupportedError):
                difmesh.read_mesh(self.path("cube.drc"))
        self.assertEqual(os.listdir(self.folder), [])

    @unittest.skipUnless(difmesh.has("gltf"), "no glTF")
    def test_warnings(self):
        path = self.path("cube.glb")
        size = difmesh.Mesh(*CUBE).save(path).bytes
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            difmesh.read_mesh(path)
        with open(path, "ab") as file:
            file.write(b"tail")
        with self.assertWarns(difmesh.Warning) as caught:
            mesh = difmesh.read_mesh(path)
        self.assertEqual(len(mesh.faces), 12)
        self.assertEqual(len(caught.warnings), 1)
        self.assertIn(f"end at byte {size} was left out, 4 bytes.", str(caught.warning))
        self.assertEqual(caught.filename, __file__)  # the line that called
        with warnings.catch_warnings():
            warnings.simplefilter("error", difmesh.Warning)
            with self.assertRaises(difmesh.Warning):
                difmesh.read_mesh(path)

    def test_what_fails(self):
        mesh = difmesh.Mesh(*CUBE)
        for path, exception in (
            ("cube.soap", difmesh.InvalidArgumentError),
            ("no/such/folder.ply", difmesh.FileWriteError),
            ("zero\0.ply", ValueError),
        ):
            with self.assertRaises(exception):
                mesh.save(self.path(path))
        with self.assertRaisesRegex(difmesh.InvalidArgumentError, "'plyy'.*\\.ply"):
            mesh.save(self.path("cube.ply"), format="plyy")
        self.assertEqual(os.listdir(self.folder), [])
        with self.assertRaises(OSError) as caught:
            difmesh.read_mesh(self.path("none.ply"))
        self.assertIsInstance(caught.exception, difmesh.FileMissingError)
        self.assertIn("none.ply", str(caught.exception))
        with open(self.path("bad.ply"), "w") as file:
            file.write("ply\nformat soap 1.0\n")
        with self.assertRaises(difmesh.FileFormatError):
            difmesh.read_mesh(self.path("bad.ply"))


if __name__ == "__main__":
    unittest.main()
