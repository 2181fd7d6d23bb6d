"""How the library is found, what ctypes makes of it, errors, and the package itself."""

import ctypes
import inspect
import os
import pickle
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
from support import SANITIZED, smooth_ball

import difmesh
from difmesh import _constants, _errors, _library, _prototypes, _structs

sys.path.insert(0, str(Path(__file__).parents[1]))
import header

PACKAGE = Path(__file__).parents[3] / "bindings" / "python"


def run(script, **environment):
    return subprocess.run(
        [sys.executable, "-c", script],
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
    )


class Interface(unittest.TestCase):
    def test_structs_are_those_of_the_header(self):
        layout = header.layout()
        if layout is None:
            self.skipTest("skipped: no C compiler")
        self.assertGreater(len(layout), 15)
        for name, fields in layout.items():
            struct = getattr(_structs, "".join(word.title() for word in name.split("_")))
            self.assertEqual(ctypes.sizeof(struct), fields.pop(".")[1], name)
            self.assertEqual([field for field, *_ in struct._fields_], list(fields), name)
            for field, place in fields.items():
                descriptor = getattr(struct, field)
                self.assertEqual((descriptor.offset, descriptor.size), place, f"{name}.{field}")

    def test_functions_have_the_headers_parameters(self):
        declared = header.functions()
        self.assertEqual(set(_prototypes.FUNCTIONS), set(declared))
        results = {"dif_status": ctypes.c_int32, "int32_t": ctypes.c_int32, "void": None,
                   "const char*": ctypes.c_char_p}
        for name, (kind, given) in _prototypes.FUNCTIONS.items():
            result, parameters = declared[name]
            self.assertEqual(len(given), len(parameters), name)
            self.assertIs(kind, results[result], name)
            self.assertEqual(getattr(_library.library, name).argtypes, given, name)
            for kind, parameter in zip(given, parameters):
                pointer = "*" in parameter or "[" in parameter or re.search(
                    r"dif_(function|gradient)\b", parameter)
                if pointer:
                    self.assertEqual(ctypes.sizeof(kind), 8, (name, parameter))
                else:
                    words = {"int64_t": ctypes.c_int64, "uint64_t": ctypes.c_uint64,
                             "int32_t": ctypes.c_int32, "dif_status": ctypes.c_int32,
                             "double": ctypes.c_double}
                    self.assertIs(kind, words[parameter.split()[0]], (name, parameter))

    def test_constants(self):
        constants = header.constants()
        numbers = {
            "DIF_" + name: value
            for name, value in vars(_constants).items()
            if isinstance(value, int)
        }
        self.assertEqual(numbers, {**constants, **header.macros()})
        for status, kind in _errors._TYPES.items():
            self.assertIn(status, constants.values())
            words = re.sub(r"(?<!^)([A-Z])", r"_\1", kind.__name__.removesuffix("Error")).upper()
            self.assertEqual(constants["DIF_ERROR_" + words], status)
        for module, table, prefix in (
            ("_options", "_PLACEMENTS", "DIF_PLACEMENT_"),
            ("_options", "_NORMALS", "DIF_NORMALS_"),
            ("_options", "_SIDES", "DIF_SIDE_"),
            ("_fractions", "_SHAPES", "DIF_SHAPE_"),
            ("_write_options", "_DRACO_METHODS", "DIF_DRACO_"),
            ("_write_options", "_COLOR_MAPS", "DIF_COLOR_MAP_"),
            ("_write_options", "_UP_AXES", "DIF_UP_"),
            ("_files", "_FORMATS", "DIF_FIELD_FORMAT_"),
        ):
            expected = {
                name[len(prefix) :].lower(): value
                for name, value in constants.items()
                if name.startswith(prefix) and value != 0
            }
            self.assertEqual(getattr(getattr(difmesh, module), table), expected)
        types = {
            "DIF_" + dtype.name.upper(): number
            for dtype, number in difmesh._memory.VALUE_TYPES.items()
        }
        declared = {
            name: value
            for name, value in constants.items()
            if re.fullmatch(r"DIF_(FLOAT|U?INT)\d+", name)
        }
        self.assertEqual(types, declared)
        parts = {"DIF_PART_" + name.upper(): value for name, value in difmesh._PARTS.items()}
        declared = {name: value for name, value in constants.items() if "_PART_" in name}
        self.assertEqual(parts, declared)


class Search(unittest.TestCase):
    """Where libdifmesh is looked for. The package is copied, to lie where no library is."""

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        shutil.copytree(PACKAGE / "difmesh", self.folder / "difmesh")
        self.library = Path(_library.library._name).resolve()

    def imports(self, **environment):
        done = run(
            "import difmesh; print(difmesh._library.library._name)",
            **{"PYTHONPATH": str(self.folder), "DIFMESH_LIBRARY": "", "LD_LIBRARY_PATH": "",
               **environment},
        )  # fmt: skip
        return done.stdout.strip() or done.stderr

    def test_the_variable_comes_first(self):
        shutil.copy(self.library, self.folder / "difmesh" / "libdifmesh.so.0")
        self.assertEqual(self.imports(DIFMESH_LIBRARY=str(self.library)), str(self.library))
        said = self.imports(DIFMESH_LIBRARY="/no/such.so")
        self.assertRegex(said, "ImportError: cannot load /no/such.so, which DIFMESH_LIBRARY names")

    def test_then_beside_the_package(self):
        beside = self.folder / "difmesh" / "libdifmesh.so.0"
        shutil.copy(self.library, beside)
        self.assertEqual(self.imports(), str(beside))

    def test_then_the_systems_loader(self):
        (self.folder / "lib").mkdir()
        shutil.copy(self.library, self.folder / "lib" / "libdifmesh.so.0")
        said = self.imports(LD_LIBRARY_PATH=str(self.folder / "lib"))
        self.assertEqual(said, "libdifmesh.so.0")

    def test_else_importing_fails_and_says_why(self):
        said = self.imports()
        if said == "libdifmesh.so.0":
            self.skipTest("skipped: difmesh is installed on this machine")
        self.assertRegex(said, "ImportError: cannot load libdifmesh.so.0.*DIFMESH_LIBRARY")

    def test_other_libraries_are_refused(self):
        """libm has none of our functions."""
        said = self.imports(DIFMESH_LIBRARY="libm.so.6")
        self.assertRegex(said, "ImportError: libm.so.6 has no function dif_")


class Errors(unittest.TestCase):
    def test_hierarchy(self):
        for kind, base in (
            (difmesh.InvalidArgumentError, ValueError),
            (difmesh.InvalidGridError, difmesh.InvalidArgumentError),
            (difmesh.InvalidValueError, difmesh.InvalidArgumentError),
            (difmesh.TooLargeError, OverflowError),
            (difmesh.OutOfMemoryError, MemoryError),
            (difmesh.FileMissingError, OSError),
            (difmesh.FileFormatError, ValueError),
            (difmesh.FileWriteError, OSError),
            (difmesh.UnsupportedError, NotImplementedError),
            (difmesh.CancelledError, Exception),
        ):
            self.assertTrue(issubclass(kind, base) and issubclass(kind, difmesh.Error))
            error = kind("some words", 77)
            self.assertEqual((str(error), error.status, error.name),
                             ("some words", 77, "unknown status"))
            again = pickle.loads(pickle.dumps(error))
            self.assertEqual((type(again), str(again), again.status), (kind, "some words", 77))

    def test_statuses_that_this_package_does_not_know(self):
        with self.assertRaises(difmesh.Error) as caught:
            _errors.check(12345)
        self.assertEqual(caught.exception.status, 12345)

    def test_messages_are_the_librarys(self):
        field = smooth_ball()
        field[3, 4, 5] = np.nan
        with self.assertRaises(difmesh.InvalidValueError) as caught:
            difmesh.reconstruct(field)
        message = _library.library.dif_last_message().decode()
        self.assertEqual(str(caught.exception), message)
        self.assertIn("(5, 4, 3)", message)
        self.assertEqual(caught.exception.name, "DIF_ERROR_INVALID_VALUE")

    @unittest.skipIf(SANITIZED, "skipped: AddressSanitizer's own memory knows no limits")
    def test_out_of_memory(self):
        """An address space too small for the mesh's names, coordinates and so on."""
        done = run(
            """
import resource
import numpy as np
import difmesh
field = np.random.default_rng(1).random((100, 100, 100))
used = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 30_000_000, resource.RLIM_INFINITY))
try:
    difmesh.reconstruct(field, threads=1)
except MemoryError as error:
    print(type(error).__name__, error.status)
"""
        )
        self.assertEqual(done.stdout, "OutOfMemoryError 21\n", done.stderr)


class Module(unittest.TestCase):
    def test_versions(self):
        text = (PACKAGE / "pyproject.toml").read_text()
        self.assertIn(f'\nversion = "{difmesh.__version__}"\n', text)
        self.assertEqual(difmesh.library_version().split(".")[:2],
                         difmesh.__version__.split(".")[:2])
        with self.assertRaises(ValueError):
            difmesh.has("soap")

    def test_everything_public_is_documented(self):
        for name in difmesh.__all__:
            self.assertTrue(hasattr(difmesh, name), name)
            if callable(getattr(difmesh, name)):
                self.assertTrue(getattr(difmesh, name).__doc__.strip(), name)


class Options(unittest.TestCase):
    def test_functions_take_all_options_of_their_structs(self):
        other_names = {"type": "dtype", "label_count": "labels", "lambda": "factor"}
        for function, struct, without in (
            (difmesh.reconstruct, _structs.DifOptions, ()),
            (difmesh.reconstruct_block, _structs.DifOptions, ("edge_ids",)),  # always
            (difmesh.curvature, _structs.DifCurvatureOptions, ()),
            (difmesh.smooth, _structs.DifSmoothingOptions, ()),
            (difmesh.mollify, _structs.DifMollifyOptions, ()),
            (difmesh.distance, _structs.DifDistanceOptions, ()),
            (difmesh.distance_both_ways, _structs.DifDistanceOptions, ()),
            (difmesh.fractions_from_function, _structs.DifFunctionOptions, ()),
            # A shape has a gradient of its own.
            (difmesh.fractions_from_shape, _structs.DifFunctionOptions, ("gradient",)),
            (difmesh.fractions_from_mesh, _structs.DifTriangleOptions, ()),
            (difmesh.read_mesh, _structs.DifMeshReadOptions, ()),
            (difmesh.read_field, _structs.DifFieldReadOptions, ()),
            (difmesh.write_field, _structs.DifFieldWriteOptions, ()),
        ):
            parameters = inspect.signature(function).parameters
            names = [name for name, _ in struct._fields_]
            wanted = {
                other_names.get(name, name.removeprefix("has_"))
                for name in names
                if not name.startswith(("struct_size", "reserved")) and not name.endswith("_user")
            }
            self.assertEqual(wanted - set(parameters) - set(without), set(), function.__name__)


if __name__ == "__main__":
    unittest.main()
