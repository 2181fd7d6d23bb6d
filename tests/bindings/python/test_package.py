"""That the package can be installed, and that its type hints are right."""

import importlib.util
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PACKAGE = Path(__file__).parents[3] / "bindings" / "python"


class Package(unittest.TestCase):
    def test_type_hints(self):
        if shutil.which("mypy") is None:
            self.skipTest("skipped: no mypy")
        with tempfile.TemporaryDirectory() as cache:
            done = subprocess.run(
                ["mypy", "--strict", "--cache-dir", cache, "difmesh"],
                cwd=PACKAGE, capture_output=True, text=True,
            )  # fmt: skip
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_wheel(self):
        """What pip would install: the modules and the marker of type hints, nothing else."""
        for tool in ("pip", "setuptools", "wheel"):
            if importlib.util.find_spec(tool) is None:
                self.skipTest(f"skipped: no {tool}")
        with tempfile.TemporaryDirectory() as folder:
            source = Path(folder, "source")
            shutil.copytree(PACKAGE, source)
            done = subprocess.run(
                [sys.executable, "-m", "pip", "wheel", "--no-build-isolation", "--no-deps",
                 "--no-index", "--wheel-dir", folder, source],
                capture_output=True, text=True,
            )  # fmt: skip
            self.assertEqual(done.returncode, 0, done.stderr)
            (built,) = Path(folder).glob("*.whl")
            shutil.unpack_archive(built, Path(folder, "built"), "zip")
            files = {path.name for path in Path(folder, "built", "difmesh").iterdir()}
            expected = {path.name for path in (PACKAGE / "difmesh").glob("*.py")}
            self.assertEqual(files, expected | {"py.typed"})
            done = subprocess.run(
                [sys.executable, "-c", "import difmesh; print(difmesh.__file__)"],
                env={**os.environ, "PYTHONPATH": str(Path(folder, "built"))},
                capture_output=True, text=True,
            )  # fmt: skip
            self.assertTrue(done.stdout.startswith(str(Path(folder, "built"))), done.stderr)


if __name__ == "__main__":
    unittest.main()
