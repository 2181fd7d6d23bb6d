"""Progress, cancelling, exceptions in callbacks and signals."""

import gc
import os
import signal
import subprocess
import sys
import threading
import time
import traceback
import unittest
import weakref

import numpy as np
from support import SANITIZED, same_bits, smooth_ball

import difmesh

#: So many empty cells, all of them the same element of memory, that a call takes about a second.
LONG = np.broadcast_to(np.float64(0), (50 if SANITIZED else 400, 1000, 1000))


class Progress(unittest.TestCase):
    def test_shares_rise_to_one(self):
        for call in (
            lambda progress: difmesh.reconstruct(smooth_ball(), progress=progress),
            lambda progress: difmesh.normals(smooth_ball(), progress=progress),
            lambda progress: difmesh.cell_planes(smooth_ball(), [[3, 4, 5]], progress=progress),
            lambda progress: difmesh.cell_curvature(smooth_ball(), progress=progress),
            lambda progress: difmesh.cell_surfaces(smooth_ball(), progress=progress),
            lambda progress: difmesh.cell_surfaces(smooth_ball(), [[3, 4, 5]], progress=progress),
            lambda progress: difmesh.fractions_from_shape(difmesh.Shape(), 8, progress=progress),
            lambda progress: difmesh.fractions_from_function(
                lambda points: points[:, 0] - 2.2, 8, progress=progress
            ),
            lambda progress: difmesh.fractions_from_mesh(
                difmesh.reconstruct(smooth_ball()), 24, progress=progress
            ),
        ):
            shares = []
            call(shares.append)
            self.assertEqual(shares, sorted(shares))
            self.assertGreaterEqual(shares[0], 0)
            self.assertEqual(shares[-1], 1)

    def test_false_cancels_and_nothing_else_does(self):
        for answer in (None, True, 0, "", []):
            mesh = difmesh.reconstruct(smooth_ball(), progress=lambda share: answer)
            self.assertGreater(len(mesh.faces), 0)
        calls = []

        def stop(share):
            calls.append(share)
            return len(calls) < 3

        with self.assertRaises(difmesh.CancelledError) as caught:
            difmesh.reconstruct(smooth_ball(), progress=stop)
        self.assertEqual(len(calls), 3)
        self.assertEqual((caught.exception.status, caught.exception.name),
                         (30, "DIF_ERROR_CANCELLED"))

    def test_callbacks_may_call_the_library(self):
        inner = []

        def progress(share):
            if not inner:
                inner.append(difmesh.reconstruct(smooth_ball(), progress=lambda share: None))

        outer = difmesh.reconstruct(smooth_ball(), progress=progress)
        self.assertTrue(same_bits(outer, inner[0]))

    def test_nothing_is_kept_after_the_call(self):
        for callback in (lambda share: None, lambda share: 1 / 0):
            field = smooth_ball()
            kept = weakref.ref(field)
            try:
                difmesh.reconstruct(field, progress=callback)
            except ZeroDivisionError:
                pass
            callback = weakref.ref(callback)
            del field
            gc.collect()
            self.assertIsNone(kept())

    def test_python_threads_run_meanwhile(self):
        ticks = []
        over = threading.Event()

        def tick():
            while not over.wait(0.005):
                ticks.append(time.monotonic())

        thread = threading.Thread(target=tick)
        thread.start()
        begin = time.monotonic()
        difmesh.reconstruct(LONG[:200], threads=1)
        end = time.monotonic()
        over.set()
        thread.join()
        during = sum(begin < tick < end for tick in ticks)
        self.assertGreater(during, 0)

    def test_several_threads_at_once(self):
        expected = difmesh.reconstruct(smooth_ball())
        meshes = []

        def work():
            for _ in range(5):
                meshes.append(difmesh.reconstruct(smooth_ball(), progress=lambda share: None))

        threads = [threading.Thread(target=work) for _ in range(6)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(meshes), 30)
        self.assertTrue(all(same_bits(mesh, expected) for mesh in meshes))


class Exceptions(unittest.TestCase):
    def test_in_progress(self):
        class Own(Exception):
            pass

        error = Own("stop it")
        calls = []

        def progress(share):
            calls.append(share)
            raise error

        with self.assertRaises(Own) as caught:
            difmesh.reconstruct(smooth_ball(), progress=progress)
        self.assertIs(caught.exception, error)
        self.assertEqual(len(calls), 1)
        with self.assertRaises(SystemExit):
            difmesh.reconstruct(smooth_ball(), progress=lambda share: sys.exit(3))

    def test_in_functions(self):
        def bad(points):
            raise LookupError("no such point")

        def plane(points):
            return points[:, 0] - 2.2

        for threads in (1, 3):
            with self.assertRaisesRegex(LookupError, "no such point"):
                difmesh.fractions_from_function(bad, 8, threads=threads)
        with self.assertRaisesRegex(LookupError, "no such point"):
            difmesh.fractions_from_function(plane, 8, gradient=bad)

    def test_results_of_functions(self):
        for result, words in (
            (lambda points: points, r"\(9, 3\)"),
            (lambda points: 1.0, r"shape \(\)"),
            (lambda points: points[:-1, 0], r"\(8,\)"),
            (lambda points: ["a"] * len(points), "float"),
            (lambda points: None, "shape"),
        ):
            with self.assertRaisesRegex(ValueError, words):
                difmesh.fractions_from_function(result, 8)
        with self.assertRaisesRegex(ValueError, "gradient returned.*shape"):
            difmesh.fractions_from_function(
                lambda points: points[:, 0] - 2.2, 8, gradient=lambda points: points[:, 0]
            )
        with self.assertRaises(difmesh.InvalidValueError):
            difmesh.fractions_from_function(lambda points: points[:, 0] * np.nan, 8)
        values = difmesh.fractions_from_function(
            lambda p: (p[:, 0] - 4).astype(np.float32).tolist(), 8
        )
        self.assertEqual(values.fractions.sum(), 256)


class Signals(unittest.TestCase):
    """What Ctrl-C does. Handlers raise out of the call, soon, and are in their places after it."""

    @classmethod
    def setUpClass(cls):
        begin = time.monotonic()
        difmesh.reconstruct(LONG, threads=1)
        cls.whole = time.monotonic() - begin

    def after(self, seconds, action):
        timer = threading.Timer(seconds, action)
        timer.start()
        self.addCleanup(timer.join)

    def interrupted(self, call):
        """Ctrl-C while call() runs is raised from a callback, not when all is done."""
        handlers = [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGALRM)]
        frames = []
        delay = 0.01
        # Again where it came before the library was called.
        while "call" not in frames or "__enter__" in frames:
            delay *= 2
            try:
                self.after(delay, lambda: os.kill(os.getpid(), signal.SIGINT))
                call()
                self.fail("KeyboardInterrupt was not raised")
            except KeyboardInterrupt as interrupt:
                frames = [frame.name for frame in traceback.extract_tb(interrupt.__traceback__)]
        self.assertIn("_guarded", frames)
        self.assertEqual(
            handlers, [signal.getsignal(number) for number in (signal.SIGINT, signal.SIGALRM)]
        )

    def test_without_progress(self):
        for _ in range(3):
            self.interrupted(lambda: difmesh.reconstruct(LONG, threads=1))

    def test_with_progress(self):
        shares = []
        self.interrupted(lambda: difmesh.reconstruct(LONG, threads=1, progress=shares.append))
        self.assertLess(max(shares, default=0), 1)

    def test_in_a_function(self):
        """Also while the function itself takes long."""

        def slow(points):
            deadline = time.monotonic() + 20 * self.whole
            while time.monotonic() < deadline:
                pass
            return points[:, 0]

        self.interrupted(lambda: difmesh.fractions_from_function(slow, 8))

    def test_between_many_short_functions(self):
        """The signal may come at any time, so many are tried."""
        for seed in range(25):
            calls = []
            done = threading.Event()

            def interrupt():
                while len(calls) < 3 and not done.is_set():
                    time.sleep(1e-4)
                time.sleep(1e-4 * seed)
                os.kill(os.getpid(), signal.SIGINT)

            def quick(points):
                calls.append(1)
                return np.sin(5 * points).sum(axis=1)

            thread = threading.Thread(target=interrupt)
            try:
                with self.assertRaises(KeyboardInterrupt):
                    thread.start()
                    difmesh.fractions_from_function(quick, 60, 0.1, threads=1)
                    time.sleep(5)
            finally:
                done.set()
                thread.join()
            self.assertLess(len(calls), 3000)

    def test_handlers_that_do_not_raise_let_it_go_on(self):
        seen = []
        previous = signal.signal(signal.SIGINT, lambda number, frame: seen.append(number))
        self.addCleanup(signal.signal, signal.SIGINT, previous)
        shares = []

        def progress(share):
            if not shares:
                thread = threading.Thread(target=lambda: os.kill(os.getpid(), signal.SIGINT))
                thread.start()
                thread.join()
            shares.append((share, len(seen)))

        difmesh.reconstruct(LONG, threads=1, progress=progress)
        self.assertEqual(seen, [signal.SIGINT])
        self.assertEqual(shares[-1], (1, 1))
        self.assertIn(1, [count for share, count in shares if share < 1])  # not at the end only

    def test_other_signals(self):
        def late(number, frame):
            raise TimeoutError("too late")

        previous = signal.signal(signal.SIGALRM, late)
        self.addCleanup(signal.signal, signal.SIGALRM, previous)
        with self.assertRaisesRegex(TimeoutError, "too late"):
            signal.setitimer(signal.ITIMER_REAL, 0.02)
            difmesh.reconstruct(LONG, threads=1)
        self.assertIs(signal.getsignal(signal.SIGALRM), late)

    def test_calls_within_calls(self):
        def progress(share):
            difmesh.reconstruct(LONG, threads=1)

        self.interrupted(lambda: difmesh.reconstruct(smooth_ball(), progress=progress))

    def test_a_signal_in_another_thread_waits_for_the_main_thread(self):
        results = []
        thread = threading.Thread(
            target=lambda: results.append(difmesh.reconstruct(LONG, threads=1))
        )
        thread.start()
        with self.assertRaises(KeyboardInterrupt):
            self.after(0.1 * self.whole, lambda: os.kill(os.getpid(), signal.SIGINT))
            time.sleep(10 * self.whole)
        thread.join()
        self.assertEqual(len(results), 1)

    def test_a_process(self):
        """As from a terminal: the process ends as Python does by Ctrl-C, and says nothing else."""
        script = """
import numpy as np
import difmesh
field = np.broadcast_to(np.float64(0), (4000, 1000, 1000))
print("ready", flush=True)
difmesh.reconstruct(field, purity_tolerance=0.0, threads=1)
print("finished")
"""
        child = subprocess.Popen(
            [sys.executable, "-c", script],
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        )  # fmt: skip
        self.assertEqual(child.stdout.readline(), "ready\n")
        time.sleep(0.3)
        child.send_signal(signal.SIGINT)
        out, err = child.communicate(timeout=60)
        self.assertEqual(child.returncode, -signal.SIGINT, err)
        self.assertEqual(out, "")
        self.assertIn("KeyboardInterrupt", err)
        self.assertNotIn("ignored", err)


if __name__ == "__main__":
    unittest.main()
