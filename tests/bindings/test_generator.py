"""The generator of the bindings: what it makes of a header, and what it refuses.

What it makes of difmesh.h is tested in python/test_library.py and fortran/interface.py.
"""

import ctypes
import importlib.util
import re
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
GENERATOR = ROOT / "scripts" / "generate_bindings.py"
PYTHON, FORTRAN = "bindings/python/difmesh", "bindings/fortran"

#: One of each that a header may hold, beside what difmesh.h holds today.
EVERYTHING = """\
#ifndef DIF_TEST_H
#define DIF_TEST_H
#include <stdint.h>
#if defined(_WIN32) /* of no concern */
#define DIF_API __declspec(dllexport)
#else
#define DIF_API
#endif
#ifdef __cplusplus
extern "C" {
#endif
#define DIF_LENGTH 5
typedef int32_t dif_status;
enum { DIF_OK = 0, DIF_ERROR_ODD = -3, }; // the last comma is allowed
typedef struct dif_thing dif_thing;
typedef int32_t (*dif_callback)(void* user, int64_t count, const double points[], double out[]);
typedef struct dif_inner {
  uint8_t byte;
  double number;
  int16_t pair[2];
} dif_inner;
typedef struct dif_outer {
  uint64_t struct_size;
  uint8_t flag;
  const double* tables[3];
  dif_inner inner[DIF_LENGTH];
  float low;
  const char* const* names;
  const char* name;
  dif_callback callback;
  const dif_thing* thing;
  uint16_t last;
} dif_outer;
DIF_API dif_status dif_outer_init(dif_outer* outer, uint64_t struct_size);
/* `numbers` and
 * `three` may be NULL; so says this comment of two lines. */
DIF_API dif_status dif_use(dif_thing* thing, const float numbers[], uint32_t three[3],
                           const uint64_t** borrowed, const dif_thing* const things[]);
DIF_API dif_status dif_use_text(const char* name, const char** text, dif_thing** made,
                                int32_t* one, dif_callback callback, const dif_outer* outer);
DIF_API void dif_nothing(void);
DIF_API const char* dif_word(dif_status status);
#ifdef __cplusplus
}
#endif
#endif
"""

#: A line that the generator must not guess at, and what it says.
REFUSED = [
    ("DIF_API dif_status dif_a(const double* x);", r"2: .*parameter x; write \[\] for several"),
    ("DIF_API dif_status dif_a(double** x);", "2: .*parameter x"),
    ("DIF_API dif_status dif_a(char* x);", "2: .*parameter x"),
    ("DIF_API dif_status dif_a(dif_s x);", "2: .*parameter x"),
    ("DIF_API dif_status dif_a(long x);", "2: the type long is not known"),
    ("DIF_API dif_status dif_a(unsigned int x);", "2: the type unsigned is not known"),
    ("DIF_API dif_status dif_a(int32_t);", r"2: a name is needed, '\)' found"),
    ("DIF_API dif_status dif_a();", r"2: a name is needed, '\)' found"),
    ("DIF_API double* dif_a(void);", "2: a result is"),
    ("DIF_API dif_status dif_a(void)\n{ return 0; }", "3: ';' is needed, '{' found"),
    ("DIF_API dif_status a(void);", "2: a is declared twice or not called dif_"),
    ("DIF_API dif_status dif_b(void);", "2: dif_b is declared twice"),
    ("dif_status dif_a(void);", "2: 'dif_status' begins neither"),
    ("static const int dif_a = 3;", "2: 'static' begins neither"),
    ("typedef union dif_u { int32_t a; } dif_u;", "2: the type union is not known"),
    ("typedef struct dif_t { int32_t a : 3; } dif_t;", "2: cannot read ':"),
    ("typedef struct dif_t { int32_t a, b; } dif_t;", "2: ';' is needed, ',' found"),
    ("typedef struct dif_t {\n int32_t a[2][3]; } dif_t;", "3: arrays of arrays"),
    ("typedef struct dif_t { int32_t a[]; } dif_t;", "2: the field a has no length"),
    ("typedef struct dif_t { int32_t a[DIF_N]; } dif_t;", "2: a whole number is needed"),
    ("typedef struct dif_t { int32_t a; int32_t a; } dif_t;", "2: dif_t has two fields a"),
    ("typedef struct dif_t { dif_t a; } dif_t;", "2: the type dif_t is not known"),
    ("typedef struct dif_t { } dif_t;", "2: dif_t has no fields"),
    ("typedef struct dif_t { int32_t a; } dif_u;", "2: 'dif_t' is needed, 'dif_u' found"),
    ("typedef struct dif_s dif_s;", "2: dif_s is declared twice"),
    ("typedef dif_s dif_t;", "2: dif_t is another name of something that is no number"),
    ("enum { DIF_A };", "2: '=' is needed"),
    ("enum { DIF_A = 1 << 3 };", "2: cannot read '<<"),
    ("enum { DIF_A = 4294967296 };", "2: 4294967296 is no number of 32 bits"),
    ("enum { A = 1 };", "2: the constant A is not called DIF_"),
    ("typedef enum { DIF_A = 1 } dif_e;", "2: the type enum is not known"),
    ("enum { DIF_CLASS = 1, DIF_class = 2 };", "class without DIF_ is no name in Python"),
    ("enum { DIF_ABC = 1, DIF_abc = 2 };", "DIF_abc and DIF_ABC are the same name in Fortran"),
    (f"enum {{ DIF_{'A' * 60} = 1 }};", "longer than a name of Fortran"),
    ("#define DIF_TEXT \"text\"", "2: #define DIF_TEXT"),
    ("#define DIF_MIX(a) a", "2: #define DIF_MIX"),
    ("#if X\n#define DIF_A 1\n#endif", "3: DIF_A is defined under the condition 'if X'"),
    ("#pragma once", "2: the directive #pragma once is not understood"),
    ("#include <stdio.h>", "2: #include <stdio.h> is neither"),
    ("#if X", "is not closed"),
    ("#ifdef __cplusplus\nint a;\n#endif", "3: #ifdef __cplusplus may only open and close"),
    ("/* `y` may be NULL */\nDIF_API dif_status dif_a(dif_s* x);", "3: .*`y` may be NULL; no"),
    ("DIF_API dif_status dif_a(dif_s* x /* may be NULL */);", "2: .*belongs into the comment in"),
    ("/* All may be NULL. */\nDIF_API dif_status dif_a(dif_s* x);", "3: .*not in the words"),
    ("/* `x` may be NULL */\nDIF_API dif_status dif_a(int32_t x);", "3: x is no pointer"),
]  # fmt: skip


class Generator(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)
        self.header = self.folder / "test.h"
        self.out = self.folder / "out"

    def generate(self, text, *options):
        self.header.write_text(text)
        return subprocess.run(
            [sys.executable, GENERATOR, "--header", self.header, "--out", self.out, *options],
            capture_output=True, text=True,
        )  # fmt: skip

    def made(self, name):
        return (self.out / name).read_text()

    def test_what_it_does_not_understand_is_refused_with_its_line(self):
        start = "typedef int32_t dif_status; DIF_API dif_status dif_b(void); typedef struct dif_s {"
        for line, message in REFUSED:
            done = self.generate(f"{start} int32_t a; }} dif_s;\n{line}\n")
            self.assertEqual(done.returncode, 1, line)
            self.assertRegex(done.stderr, message, line)
            self.assertNotIn("Traceback", done.stderr, line)
            if re.match(r"\d", message):
                self.assertTrue(done.stderr.startswith(f"{self.header}:{message[0]}:"), line)
            self.assertFalse(self.out.exists(), line)

    def test_check_says_what_is_out_of_date_and_what_to_run(self):
        self.assertEqual(self.generate(EVERYTHING, "--check").returncode, 1)
        self.assertFalse(self.out.exists())
        self.assertEqual(self.generate(EVERYTHING).returncode, 0)
        done = self.generate(EVERYTHING, "--check")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = self.generate(EVERYTHING.replace("float low", "float high"), "--check")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(
            [line.replace(str(self.out), "") for line in done.stderr.splitlines()],
            [f"/{name} is not what the header says; run scripts/generate_bindings.py"
             for name in (f"{PYTHON}/_structs.py", f"{FORTRAN}/difmesh_types.f90")],
        )  # fmt: skip

    def test_included_headers_of_the_library_are_read_once(self):
        (self.folder / "more.h").write_text("enum { DIF_MORE = 7 };\n")
        include = '#include "more.h"\n'
        self.assertEqual(self.generate(include * 2 + EVERYTHING).returncode, 0)
        self.assertEqual(self.made(f"{PYTHON}/_constants.py").count("MORE = 7\n"), 1)
        (self.folder / "more.h").write_text("enum { DIF_MORE = seven };\n")
        self.assertRegex(self.generate(include).stderr, "more.h:1: .*'seven' found")

    def structs(self):
        """The generated module of structs."""
        package = self.out / PYTHON
        shutil.copy(ROOT / PYTHON / "_sized.py", package)
        for name in ("generated", "generated._sized", "generated._structs"):
            self.addCleanup(sys.modules.pop, name, None)
        sys.modules["generated"] = types.ModuleType("generated")
        sys.modules["generated"].__path__ = [str(package)]
        return importlib.import_module("generated._structs")

    def test_python_has_the_structs_of_the_c_compiler(self):
        compiler = shutil.which("cc") or shutil.which("gcc")
        if compiler is None:
            self.skipTest("skipped: no C compiler")
        self.assertEqual(self.generate(EVERYTHING).returncode, 0)
        structs = self.structs()
        lines = ["#include <stddef.h>", '#include "test.h"']

        def claim(what, name):
            lines.append(f'_Static_assert({what}, "{name}");')

        for name, struct in (("dif_inner", structs.DifInner), ("dif_outer", structs.DifOuter)):
            claim(f"sizeof({name}) == {ctypes.sizeof(struct)}", name)
            for field, *_ in struct._fields_:
                of = getattr(struct, field)
                claim(f"offsetof({name}, {field}) == {of.offset}", field)
                claim(f"sizeof((({name}*)0)->{field}) == {of.size}", field)
        source = self.folder / "layout.c"
        source.write_text("\n".join(lines) + "\n")
        done = subprocess.run([compiler, "-std=c11", "-fsyntax-only", source],
                              capture_output=True, text=True)  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(structs.DifOuter().struct_size, ctypes.sizeof(structs.DifOuter))
        self.assertFalse(hasattr(structs.DifInner, "struct_size"))

    def test_fortran_compiles_and_has_the_structs_of_c(self):
        fortran, compiler = shutil.which("gfortran"), shutil.which("cc") or shutil.which("gcc")
        if fortran is None or compiler is None:
            self.skipTest("skipped: no gfortran or no C compiler")
        self.assertEqual(self.generate(EVERYTHING).returncode, 0)
        sources = [self.out / FORTRAN / f"difmesh_{name}.f90" for name in ("types", "c", "init")]
        main = self.folder / "main.f90"
        main.write_text(
            "use, intrinsic :: iso_c_binding\nuse difmesh_types\nuse difmesh_init\n"
            "type(dif_inner) :: inner\ntype(dif_outer) :: outer\ncall dif_init(outer)\n"
            "print '(*(i0, 1x))', c_sizeof(inner), c_sizeof(outer), outer%struct_size, &\n"
            "  dif_error_odd, dif_length, size(outer%inner)\nend\n"
        )
        implementation = self.folder / "outer.c"
        implementation.write_text(
            '#include "test.h"\n#include <stdio.h>\n'
            "int32_t dif_outer_init(dif_outer* outer, uint64_t struct_size) {\n"
            '  printf("%zu %zu\\n", sizeof(dif_inner), sizeof *outer);\n  fflush(stdout);\n'
            "  outer->struct_size = struct_size;\n  return 0;\n}\n"
        )
        thing = self.folder / "thing.o"
        program = self.folder / "program"
        for command in (
            [compiler, "-std=c99", "-c", implementation, "-o", thing],
            [fortran, "-std=f2018", "-Wall", "-Wextra", "-Werror", f"-J{self.folder}", *sources,
             main, thing, "-o", program],
        ):  # fmt: skip
            done = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
        said = subprocess.run([program], capture_output=True, text=True, check=True).stdout
        of_c, of_fortran = said.splitlines()
        self.assertEqual(of_fortran.split(), [*of_c.split(), of_c.split()[1], "-3", "5", "5"])

    def test_what_parameters_become(self):
        self.assertEqual(self.generate(EVERYTHING).returncode, 0)
        text = " ".join(self.made(f"{FORTRAN}/difmesh_c.f90").replace("&\n", "").split())
        for declared in (
            "function dif_use(thing, numbers, three, borrowed, things) bind(c)",
            "type(c_ptr), value :: thing ",
            "real(c_float), intent(in), optional :: numbers(*) ",
            "integer(c_int32_t), intent(inout), optional :: three(3) ",
            "type(c_ptr), intent(inout) :: borrowed ",
            "type(c_ptr), intent(in) :: things(*) ",
            "character(kind=c_char), intent(in) :: name(*) ",
            "type(c_ptr), intent(inout) :: text ",
            "type(c_ptr), intent(inout) :: made ",
            "integer(c_int32_t), intent(inout) :: one ",
            "type(c_funptr), value :: callback ",
            "type(dif_outer), intent(in) :: outer ",
            "subroutine dif_nothing() bind(c) end subroutine",
            "type(c_ptr) function dif_word(status) bind(c)",
        ):
            self.assertIn(declared, text)
        self.assertEqual(text.count("optional"), 3)  # the first comment's is one, in the words
        text = " ".join(self.made(f"{PYTHON}/_prototypes.py").split())
        for declared in (
            '"dif_use": ( c_int32, [c_void_p, c_void_p, POINTER(c_uint32), POINTER(c_void_p), '
            "POINTER(c_void_p)],",
            "[ c_char_p, POINTER(c_char_p), POINTER(c_void_p), POINTER(c_int32), s.DifCallback, "
            "POINTER(s.DifOuter), ]",
            '"dif_nothing": (None, []),',
            '"dif_word": (c_char_p, [c_int32]),',
        ):
            self.assertIn(declared, text)


if __name__ == "__main__":
    unittest.main()
