"""Which arrays are taken, that they are read where they lie, and what results look like."""

import gc
import resource
import subprocess
import sys
import unittest
import weakref

import numpy as np
from support import SANITIZED, same_bits, smooth_ball

import difmesh
from difmesh import _memory


class Layouts(unittest.TestCase):
    """The same numbers, however they lie, give the same bits."""

    @classmethod
    def setUpClass(cls):
        cls.field = smooth_ball()
        cls.expected = difmesh.reconstruct(cls.field)

    def check(self, array, **options):
        struct, kept = _memory.field_struct(array, None, None, options.get("axes", "kji"))
        self.assertEqual(struct.data, array.__array_interface__["data"][0])  # not copied
        self.assertTrue(np.shares_memory(kept, array))
        self.assertTrue(same_bits(difmesh.reconstruct(array, **options), self.expected))

    def test_contiguous(self):
        self.assertGreater(len(self.expected.faces), 500)
        self.check(self.field)

    def test_fortran_order(self):
        self.check(np.asfortranarray(self.field))

    def test_i_j_k(self):
        self.check(self.field.T, axes="ijk")
        self.check(np.ascontiguousarray(self.field.T), axes="ijk")

    def test_ghost_layers(self):
        nz, ny, nx = self.field.shape
        padded = np.full((nz + 3, ny + 2, nx + 5), np.nan)
        inside = padded[1:-2, 1:-1, 2:-3]
        inside[...] = self.field
        self.check(inside)

    def test_every_other_element(self):
        nz, ny, nx = self.field.shape
        sparse = np.full((2 * nz, 3 * ny, 2 * nx), np.nan)
        inside = sparse[::2, 1::3, 1::2]
        inside[...] = self.field
        self.check(inside)

    def test_negative_strides(self):
        turned = np.ascontiguousarray(self.field[::-1, ::-1, ::-1])
        self.check(turned[::-1, ::-1, ::-1])

    def test_member_of_records(self):
        records = np.zeros(self.field.shape, dtype=[("alpha", "f8"), ("p", "f8")])
        records["alpha"] = self.field
        self.check(records["alpha"])

    def test_read_only_and_memory_mapped(self):
        locked = self.field.copy()
        locked.flags.writeable = False
        self.check(locked)

    def test_stride_of_an_axis_of_one_cell_does_not_matter(self):
        one = np.lib.stride_tricks.as_strided(self.field, (1, 19, 24), (3, 19 * 8, 8))[:, :, :3]
        struct, _ = _memory.field_struct(one, None, None, "kji")
        self.assertEqual(struct.strides[2], 0)


class Types(unittest.TestCase):
    def test_float32(self):
        field = smooth_ball().astype(np.float32)
        self.assertTrue(
            same_bits(difmesh.reconstruct(field), difmesh.reconstruct(field.astype(np.float64)))
        )

    def test_integers_are_shares_of_their_largest_value(self):
        for dtype, most in ((np.uint8, 255), (np.uint16, 65535)):
            field = np.rint(smooth_ball() * most).astype(dtype)
            self.assertTrue(
                same_bits(difmesh.reconstruct(field), difmesh.reconstruct(field / float(most)))
            )

    def test_bool_means_empty_and_full(self):
        mask = smooth_ball() > 0.5
        for array in (mask, mask[::-1, :, ::-1][::-1, :, ::-1]):
            mesh = difmesh.reconstruct(array)
            self.assertTrue(same_bits(mesh, difmesh.reconstruct(mask.astype(np.float64))))

    def test_lists(self):
        field = smooth_ball(8, 8, 8)
        self.assertTrue(
            same_bits(difmesh.reconstruct(field.tolist()), difmesh.reconstruct(field))
        )

    def refused(self, array, exception, *words, **options):
        with self.assertRaises(exception) as caught:
            difmesh.reconstruct(array, **options)
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_other_types_are_refused(self):
        field = smooth_ball(6, 6, 6)
        for dtype in (np.int64, np.int8, np.uint32, np.float16, np.complex128, object, "U3"):
            self.refused(field.astype(dtype), TypeError, "dtype", "uint16")
        self.refused(field.astype(field.dtype.newbyteorder()), TypeError, "byte order")
        self.refused(np.ma.masked_less(field, 0.1), TypeError, "masked")

    def test_shapes_are_refused(self):
        self.refused(np.zeros((4, 4)), ValueError, "3 axes", "(4, 4)")
        self.refused(np.zeros((1, 4, 4, 4)), ValueError, "3 axes")
        self.refused(np.zeros((4, 0, 4)), difmesh.InvalidGridError, "0 cells in y")
        self.refused(np.zeros((4, 4, 4)), ValueError, "axes", "'ijk'", axes="xyz")

    def test_unaligned_elements_are_refused(self):
        raw = np.zeros(6 * 6 * 6 * 8 + 1, np.uint8)
        shifted = raw[1:].view(np.float64).reshape(6, 6, 6)
        self.refused(shifted, ValueError, "unaligned", "copy()")
        packed = np.zeros((6, 6, 6), dtype=[("flag", "u1"), ("alpha", "f8")])["alpha"]
        self.refused(packed, ValueError, "unaligned", "9)")
        # Aligned as x86 has it, but no whole number of elements apart.
        halves = np.zeros((6, 6, 6), dtype=[("alpha", "f8"), ("id", "u4")])["alpha"]
        self.refused(halves, ValueError, "12)")
        self.assertEqual(len(difmesh.reconstruct(packed.copy()).faces), 0)

    def test_spacing_and_origin(self):
        self.refused(smooth_ball(6, 6, 6), ValueError, "spacing", "(2,)", spacing=(1, 2))
        self.refused(
            smooth_ball(6, 6, 6), difmesh.InvalidGridError, "spacing in y", spacing=(1, 0, 1)
        )
        field = smooth_ball()
        plain = difmesh.reconstruct(field)
        placed = difmesh.reconstruct(field, spacing=(0.5, 0.25, 2), origin=[1, 2, 3])
        self.assertEqual(placed.faces.tobytes(), difmesh.reconstruct(
            field, spacing=np.array([0.5, 0.25, 2.0]), origin=(1, 2, 3)).faces.tobytes())
        middle = placed.points.mean(axis=0)
        expected = plain.points.mean(axis=0) * (0.5, 0.25, 2) + (1, 2, 3)
        np.testing.assert_allclose(middle, expected, rtol=0, atol=0.05)


class Results(unittest.TestCase):
    def test_arrays_keep_the_memory_of_the_mesh(self):
        mesh = difmesh.reconstruct(smooth_ball(), vertex_normals=True, edge_ids=True)
        arrays = [mesh.points, mesh.faces, mesh.normals, mesh.edge_ids]
        copies = [array.copy() for array in arrays]
        handle = weakref.ref(mesh._handle)
        del mesh
        gc.collect()
        self.assertIsNotNone(handle())
        for _ in range(20):  # would reuse the memory if it were free
            difmesh.reconstruct(np.flip(smooth_ball(), 0), vertex_normals=True, edge_ids=True)
        for array, copy in zip(arrays, copies):
            np.testing.assert_array_equal(array, copy)
        part = arrays[0][10:20, 1]
        del arrays, array
        gc.collect()
        self.assertIsNotNone(handle())
        np.testing.assert_array_equal(part, copies[0][10:20, 1])
        del part
        gc.collect()
        self.assertIsNone(handle())  # and free at last

    def test_arrays_are_views_and_read_only(self):
        mesh = difmesh.reconstruct(smooth_ball(), vertex_normals=True, edge_ids=True)
        self.assertTrue(np.shares_memory(mesh.points, mesh.points))
        n, m = len(mesh.points), len(mesh.faces)
        for array, shape, dtype in (
            (mesh.points, (n, 3), np.float64),
            (mesh.faces, (m, 3), np.uint32),
            (mesh.normals, (n, 3), np.float64),
            (mesh.edge_ids, (n,), np.uint64),
        ):
            self.assertEqual(array.shape, shape)
            self.assertEqual(array.dtype, dtype)
            with self.assertRaises(ValueError):
                array[0] = 0
            with self.assertRaises(ValueError):
                array.flags.writeable = True

    def test_meshes_of_nothing(self):
        mesh = difmesh.reconstruct(np.zeros((4, 4, 4)), vertex_normals=True, edge_ids=True)
        self.assertEqual(mesh.points.shape, (0, 3))
        self.assertEqual(mesh.faces.shape, (0, 3))
        self.assertIsNone(mesh.normals)
        self.assertIsNone(mesh.edge_ids)
        self.assertTrue(mesh.report.closed)

    @unittest.skipIf(SANITIZED, "skipped: AddressSanitizer keeps what is freed for a while")
    def test_handles_are_freed(self):
        field = smooth_ball(64, 64, 64)
        difmesh.reconstruct(field)
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        for _ in range(300):
            difmesh.reconstruct(field, purity_tolerance=0, vertex_normals=True)
        grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
        bytes_each = len(difmesh.reconstruct(field).points) * 96
        self.assertLess(grown * 1024, 0.25 * 300 * bytes_each + 2e7)


class Memory(unittest.TestCase):
    def test_a_field_is_not_copied(self):
        """Peak memory of a fresh process grows by far less than the field's size."""
        script = """
import sys
import numpy as np
import difmesh

def peak():  # not of getrusage(), which counts the process that started this one
    (line,) = (line for line in open("/proc/self/status") if line.startswith("VmHWM"))
    return int(line.split()[1]) * 1024

difmesh.reconstruct(np.zeros((8, 8, 8)))
whole = np.empty((200, 200, 204))
whole[...] = 0
field = whole[:, :, 2:-2]
field[90:110, 90:110, 90:110] = 1
before = peak()
mesh = difmesh.reconstruct(field)
grown = peak() - before
assert len(mesh.faces) > 1000
sys.exit(0 if grown < 0.2 * field.nbytes else f"{grown} bytes of {field.nbytes}")
"""
        done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)


if __name__ == "__main__":
    unittest.main()
