"""Fields of integers: what their values stand for, and what reading tells beside the field."""

import os
import tempfile
import unittest
import warnings

import numpy as np
from support import same_bits

import difmesh

INTEGERS = [np.dtype(f"{kind}{size}") for kind in "iu" for size in (1, 2, 4, 8)]


def ball_mask():
    k, j, i = np.indices((14, 12, 13))
    return (i - 6) ** 2 + (j - 5.5) ** 2 + (k - 6.5) ** 2 < 20


class Values(unittest.TestCase):
    def test_labels_give_the_surface_of_the_mask(self):
        mask = ball_mask()
        wanted = difmesh.reconstruct(mask)
        self.assertGreater(wanted.report.enclosed_volume, 300)
        for dtype in INTEGERS + [np.dtype("f4"), np.dtype("f8"), np.dtype("f2")]:
            with self.subTest(dtype=dtype):
                labelled = np.where(mask, 3, 9).astype(dtype)
                self.assertTrue(same_bits(difmesh.reconstruct(labelled, labels=3), wanted))
                labelled[0, 0, 0] = 5
                self.assertTrue(same_bits(difmesh.reconstruct(labelled, labels=[4, 3]), wanted))
        self.assertTrue(same_bits(difmesh.reconstruct(mask, labels=1), wanted))
        labelled = np.where(mask, 3, 9)
        inside_out = labelled.transpose(2, 1, 0)
        self.assertTrue(same_bits(difmesh.reconstruct(inside_out, labels=3, axes="ijk"), wanted))
        swapped = labelled.astype(">i4")[::-1, ::-1, ::-1][::-1, ::-1, ::-1]
        self.assertTrue(same_bits(difmesh.reconstruct(swapped, labels=3), wanted))
        field = difmesh.Field(labelled, spacing=(0.5, 0.5, 0.5), origin=(1.0, 2.0, 3.0))
        mesh = difmesh.reconstruct(field, labels=3)
        np.testing.assert_allclose(mesh.points, wanted.points * 0.5 + [1, 2, 3], atol=1e-12)

    def test_a_full_value_scales(self):
        random = np.random.default_rng(5)
        for dtype in INTEGERS + [np.dtype("f4"), np.dtype("f8")]:
            with self.subTest(dtype=dtype):
                values = random.integers(0, 120, (3, 4, 5)).astype(dtype)
                np.testing.assert_array_equal(
                    difmesh.fractions_from_values(values, 100, 20),
                    np.clip((values.astype(float) - 20) / 80, 0, 1),
                )
                np.testing.assert_array_equal(
                    difmesh.fractions_from_labels(values[:, ::-1, 1:], range(20, 60)),
                    np.where((values >= 20) & (values < 60), 255, 0)[:, ::-1, 1:],
                )
        mask = ball_mask()
        self.assertTrue(
            same_bits(difmesh.reconstruct(mask * -7, full_value=-7),
                      difmesh.reconstruct(mask * 1.0))
        )

    def test_a_mask_taken_as_fractions_brings_a_warning(self):
        mask = ball_mask().astype(np.uint8)
        with self.assertWarnsRegex(difmesh.Warning, "highest value is 1.*255.*labels") as caught:
            mesh = difmesh.reconstruct(mask)
        self.assertEqual(os.path.basename(caught.filename), "test_values.py")
        self.assertEqual(len(mesh.faces), 0)
        high = "highest value is 200.*255 of uint8"
        with self.assertWarnsRegex(difmesh.Warning, high) as caught:
            mesh = difmesh.reconstruct(mask * np.uint8(200))
        self.assertEqual(os.path.basename(caught.filename), "test_values.py")
        self.assertGreater(len(mesh.faces), 0)
        scan = np.random.default_rng(1).integers(0, 250, (9, 9, 9)).astype(np.uint8)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            difmesh.reconstruct(scan)
            difmesh.reconstruct(mask * np.uint8(200), labels=200)
            difmesh.reconstruct(mask, labels=1)
            difmesh.reconstruct(mask, labels=2)
            difmesh.reconstruct(np.full((3, 3, 3), 255, np.uint8))
            difmesh.reconstruct(np.zeros((3, 3, 3)))

    def test_what_is_refused(self):
        values = np.ones((2, 2, 2), int)
        for options in (
            {"labels": []},
            {"labels": 1.5},
            {"labels": [[1]]},
            {"labels": 1, "full_value": 2},
            {"empty_value": 1},
            {"labels": np.uint64(2**63)},
        ):
            with self.subTest(options=options), self.assertRaises(ValueError):
                difmesh.reconstruct(values, **options)
        with self.assertRaises(difmesh.InvalidArgumentError):
            difmesh.reconstruct(values, full_value=0)
        with self.assertRaisesRegex(TypeError, "labels"):
            difmesh.reconstruct(values)
        with self.assertRaises(TypeError):
            difmesh.fractions_from_values(values + 1j, 2)
        with self.assertRaises(ValueError):
            difmesh.fractions_from_labels(values[0], 2)
        with self.assertRaises(TypeError):
            difmesh.fractions_from_labels(np.ma.masked_array(values), 2)


@unittest.skipUnless(difmesh.has("files"), "a library without files")
class Files(unittest.TestCase):
    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self.addCleanup(self._folder.cleanup)

    def path(self, name):
        return os.path.join(self._folder.name, name)

    def test_what_numpy_writes(self):
        values = np.random.default_rng(7).integers(0, 100, (3, 4, 5))
        for dtype in INTEGERS:
            for order in "<>":
                for fortran in (False, True):
                    with self.subTest(dtype=dtype, order=order, fortran=fortran):
                        array = values.astype(dtype.newbyteorder(order))
                        array = np.asfortranarray(array) if fortran else array
                        np.save(self.path("v.npy"), array)
                        field = difmesh.read_field(self.path("v.npy"), labels=[3, 50, 99])
                        np.testing.assert_array_equal(
                            field.fractions, np.where(np.isin(values, [3, 50, 99]), 255, 0)
                        )
                        field = difmesh.read_field(
                            self.path("v.npy"), full_value=80, empty_value=16
                        )
                        np.testing.assert_array_equal(
                            field.fractions, np.clip((values - 16) / 64, 0, 1)
                        )
        halves = np.random.default_rng(8).random((3, 4, 5)).astype(np.float16)
        np.save(self.path("h.npy"), halves[None])
        np.testing.assert_array_equal(difmesh.read_field(self.path("h.npy")).fractions, halves)

    def test_integers_of_other_types_are_shares_of_the_largest(self):
        values = np.random.default_rng(9).integers(-(2**31), 2**31, (3, 4, 5), dtype=np.int32)
        np.save(self.path("v.npy"), values)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            field = difmesh.read_field(self.path("v.npy"))
        np.testing.assert_array_equal(field.fractions, values / (2**31 - 1))
        values.tofile(self.path("v.raw"))
        raw = difmesh.read_field(self.path("v.raw"), dims=(5, 4, 3), dtype=np.int32)
        np.testing.assert_array_equal(raw.fractions, field.fractions)

    def test_a_mask_brings_a_warning(self):
        np.save(self.path("mask.npy"), np.ones((2, 2, 2), int))
        with self.assertWarnsRegex(difmesh.Warning, "mask.npy.*highest value is 1") as caught:
            difmesh.read_field(self.path("mask.npy"))
        self.assertEqual(os.path.basename(caught.filename), "test_values.py")

    def test_the_grid_of_the_user_and_data_elsewhere(self):
        header = (
            "NRRD0004\ntype: float\ndimension: 3\nsizes: 3 2 1\nendian: little\nencoding: raw\n"
            "spacings: 1 1 0\ndata file: ../data.raw\n"
        )
        os.mkdir(self.path("inner"))
        np.arange(6, dtype="<f4").tofile(self.path("data.raw"))
        with open(self.path("inner/f.nhdr"), "w") as file:
            file.write(header)
        path = self.path("inner/f.nhdr")
        with self.assertRaisesRegex(difmesh.FileFormatError, "spacing along axis 2"):
            difmesh.read_field(path, outside_files=True)
        with self.assertRaisesRegex(difmesh.FileFormatError, "allowed"):
            difmesh.read_field(path, spacing=2)
        field = difmesh.read_field(path, spacing=2, origin=(1, 2, 3), outside_files=True)
        np.testing.assert_array_equal(field.fractions, np.arange(6).reshape(1, 2, 3))
        self.assertEqual((field.spacing, field.origin), ((2, 2, 2), (1, 2, 3)))

    @unittest.skipUnless(difmesh.has("gltf"), "a library without glTF")
    def test_buffers_elsewhere(self):
        mesh = difmesh.reconstruct(ball_mask())
        mesh.save(self.path("m.glb"))
        with open(self.path("m.glb"), "rb") as file:
            data = file.read()
        end = 20 + int.from_bytes(data[12:16], "little")
        text = data[20:end].decode()
        self.assertIn('"buffers":[{', text)
        os.mkdir(self.path("inner"))
        with open(self.path("inner/m.gltf"), "w") as file:
            file.write(text.replace('"buffers":[{', '"buffers":[{"uri":"../m.bin",'))
        with open(self.path("m.bin"), "wb") as file:
            file.write(data[end + 8 :])
        with self.assertRaisesRegex(difmesh.FileFormatError, "outside"):
            difmesh.read_mesh(self.path("inner/m.gltf"))
        again = difmesh.read_mesh(self.path("inner/m.gltf"), outside_files=True)
        self.assertTrue(same_bits(again, difmesh.read_mesh(self.path("m.glb"))))


if __name__ == "__main__":
    unittest.main()
