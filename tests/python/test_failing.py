# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""What goes wrong: exceptions by kind, Ctrl-C, callbacks, threads of Python."""

import signal
import subprocess
import sys
import threading

import numpy as np
import pytest

import crease
from conftest import roof


@pytest.mark.parametrize("status, kind, call", [
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.detect(cloud, neighbours=2)),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.detect(cloud, detector="nose")),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.detect(cloud, neighbours=16.5)),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.detect(cloud, neighbours=2**40)),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.filter(cloud, sigma=float("nan"))),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.detect(cloud, threads=5000)),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.detect(cloud, seed=-1)),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.fit(cloud, method="part", order=3)),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.fit(cloud, method="magic")),
    ("ARGUMENT", crease.UsageError, lambda cloud, _: crease.fit(cloud, method="sheet", net=(6, 6, 6))),
    ("ARGUMENT", crease.UsageError, lambda cloud, folder: crease.write(folder / "a.xls", cloud)),
    ("NO_SUCH_FILE", crease.InputError, lambda _, folder: crease.read(folder / "none.ply")),
    ("FORMAT", crease.InputError, lambda _, folder: crease.read(folder / "bad.ply")),
    ("VALUE", crease.InputError, lambda cloud, _: crease.Cloud(cloud * np.inf)),
    ("TOO_FEW_POINTS", crease.InputError, lambda cloud, _: crease.detect(cloud[:3])),
    ("DEGENERATE", crease.InputError, lambda cloud, _: crease.fit(cloud * [1, 0, 0], method="sheet")),
    ("CANNOT_WRITE", crease.Failure,
     lambda cloud, folder: crease.write(folder / "none" / "a.ply", cloud)),
])
def test_failures_are_exceptions_by_kind(tmp_path, status, kind, call):
    (tmp_path / "bad.ply").write_text("ply\nformat nonsense 1.0\nend_header\n")
    with pytest.raises(kind) as caught:
        call(roof(100), tmp_path)
    assert caught.value.status == status and len(str(caught.value)) > 10
    assert isinstance(caught.value, crease.Error)


def test_a_limit_of_memory_is_kept():
    with pytest.raises(MemoryError, match="within the limit"):
        crease.detect(roof(30000), memory="1M")
    assert len(crease.detect(roof(600), memory="8G").region) == 600
    assert len(crease.detect(roof(600), memory=8 * 10**9).region) == 600
    for wrong in ("much", "2X", "-3G", 2.5):
        with pytest.raises(crease.UsageError):
            crease.detect(roof(600), memory=wrong)


def test_unknown_options_are_refused_as_python_does():
    with pytest.raises(TypeError, match="colour"):
        crease.fit(roof(100), colour="red")


def test_progress_is_told_in_stages_up_to_the_end():
    told = []
    crease.detect(roof(600), threads=2, progress=lambda stage, done: told.append((stage, done)))
    assert len({stage for stage, _ in told}) > 1
    assert all(0 <= done <= 1 for _, done in told)


def test_an_exception_of_the_callback_ends_the_work_and_comes_out():
    calls = []

    def refuse(stage, done):
        calls.append(stage)
        raise ZeroDivisionError("enough")
    with pytest.raises(ZeroDivisionError, match="enough"):
        crease.fit(roof(2000), method="sheet", progress=refuse)
    assert len(calls) == 1


def test_an_interrupt_during_the_work_is_a_keyboard_interrupt():
    def interrupt(stage, done):
        signal.raise_signal(signal.SIGINT)
    before = signal.getsignal(signal.SIGINT)
    with pytest.raises(KeyboardInterrupt):
        crease.detect(roof(3000), progress=interrupt)
    assert signal.getsignal(signal.SIGINT) is before


def test_ctrl_c_from_outside_ends_a_long_call():
    script = ("import crease, numpy as np\n"
              "print('begun', flush=True)\n"
              "crease.detect(np.random.default_rng(1).random((400000, 3)), resamples=5000)\n")
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True)
    assert process.stdout.readline() == "begun\n"
    threading.Event().wait(0.5)
    process.send_signal(signal.SIGINT)
    _, said = process.communicate(timeout=20)
    assert process.returncode == -signal.SIGINT
    assert said.rstrip().endswith("KeyboardInterrupt") and "ignored" not in said


def test_a_handler_that_does_not_raise_lets_the_work_go_on():
    noted = []
    before = signal.signal(signal.SIGINT, lambda number, frame: noted.append(number))
    try:
        found = crease.detect(roof(600), progress=lambda stage, done: noted or signal.raise_signal(
            signal.SIGINT))
    finally:
        signal.signal(signal.SIGINT, before)
    assert noted == [signal.SIGINT] and len(found.variance) == 600


def test_several_threads_of_python_work_at_the_same_time():
    clouds = [roof(400, seed=seed) for seed in range(4)]
    alone = [crease.fit(cloud, method="sheet", threads=1).deviations for cloud in clouds]
    together = [None] * 4

    def work(index):
        together[index] = crease.fit(clouds[index], method="sheet", threads=1).deviations
    threads = [threading.Thread(target=work, args=(index,)) for index in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(one, other) for one, other in zip(alone, together))


def test_a_forked_process_works_with_one_thread():
    script = ("import crease, os, signal, sys\n"
              "cloud = crease.example('panel', count=3000)\n"
              "here = crease.detect(cloud, threads=2).variance.tobytes()\n"
              "if os.fork():\n"
              "    sys.exit(os.waitstatus_to_exitcode(os.wait()[1]))\n"
              "signal.alarm(40)\n"
              "os._exit(0 if crease.detect(cloud, threads=2).variance.tobytes() == here else 1)\n")
    assert subprocess.run([sys.executable, "-c", script], timeout=60).returncode == 0


def test_memory_that_runs_out_is_a_memory_error():
    script = ("import resource, numpy as np, crease\n"
              "cloud = crease.Cloud(np.random.default_rng(1).random((200000, 3)))\n"
              "used = int(open('/proc/self/statm').read().split()[0]) * resource.getpagesize()\n"
              "resource.setrlimit(resource.RLIMIT_AS, (used + 2**23, used + 2**23))\n"
              "try:\n"
              "    crease.detect(cloud, threads=1)\n"
              "except MemoryError as error:\n"
              "    print(error)\n")
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert "memory" in done.stdout, done.stderr
