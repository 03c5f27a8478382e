"""Compiled code on disk is used if it is whole, for this processor, and nobody else wrote it."""

from __future__ import annotations

import logging
import os
import pickle
import platform
import random as chance
import resource
import signal
import stat
import subprocess
import sys
from pathlib import Path

import numba
import numpy as np
import pytest
import small_program
from paths import ROOT
from small_program import renamed

from foamprb.compile import cache as caching
from foamprb.compile import link as linking
from foamprb.compile import processor
from foamprb.compile.cache import Store
from foamprb.compile.link import is_compiled, link, traced
from foamprb.errors import InputError

IS_ROOT = os.geteuid() == 0
SOMEBODY = 54321

PROGRAM = """
import logging, os, pathlib, sys
logging.basicConfig(level=logging.INFO, format="%(message)s", stream=sys.stdout)
from foamprb.compile import cache
from foamprb.compile.link import is_compiled, link
from small_program import swapped
cache.SUPPLIED = pathlib.Path(os.environ.get("SUPPLIED", cache.SUPPLIED))
f = link(swapped)
print(is_compiled(f), f((1.0, 3.0)), is_compiled(f), sum(f.stats.cache_hits.values()))
"""
FOUND, NOT_FOUND = "True (3.0, -5.0) True 1", "False (3.0, -5.0) True 0"


def swapped_by_hand(pair):
    return pair[1], pair[0]


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """An empty cache, with nothing compiled in this process and nothing said."""
    folder = tmp_path / "cache"
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(folder))
    monkeypatch.setattr(linking, "_dispatchers", {})
    monkeypatch.setattr(caching, "_told", set())
    return folder


@pytest.fixture
def forget(monkeypatch):
    """Do as if another process began."""
    return lambda: monkeypatch.setattr(linking, "_dispatchers", {})


def start(cache, before=None, **variables):
    environment = {
        **os.environ,
        "PYTHONPATH": f"{ROOT}:{ROOT}/tests",
        "FOAMPRB_CACHE_DIR": str(cache),
        **variables,
    }
    return subprocess.Popen(
        [sys.executable, "-c", PROGRAM], env=environment, stdout=subprocess.PIPE, text=True, preexec_fn=before
    )


def said(process):
    output, _ = process.communicate()
    assert process.returncode == 0
    return output.splitlines()


def compiled():
    """Compile the small program, or find it; how often it was found."""
    f = link(small_program.outer)
    assert f(small_program.example()) == pytest.approx(
        small_program.outer(small_program.example()), rel=1e-13
    )
    return sum(f.stats.cache_hits.values())


class TestDamage:
    def test_any_byte_that_changed_is_seen(self, folder):
        store = Store("name")
        store.save("key", list(range(50)))
        (file,) = folder.rglob("*.code")
        whole = file.read_bytes()
        assert store.load("key") == list(range(50))
        for at in range(len(whole)):
            file.write_bytes(whole[:at] + bytes([whole[at] ^ 1 << at % 8]) + whole[at + 1 :])
            assert store.load("key") is None
            file.write_bytes(whole[:at])
            assert store.load("key") is None
        file.write_bytes(whole + b"\0")
        assert store.load("key") is None
        file.write_bytes(whole)
        assert store.load("key") == list(range(50))

    @pytest.mark.usefixtures("folder")
    def test_a_file_of_another_function_or_type_is_not_used(self):
        """Whoever copies files about, a tool for backups or somebody else, may mix them up."""
        store, other = Store("name"), Store("other")
        store.save("key", 1)
        other.save("key", 2)
        store.save("key 2", 3)
        one, another = (s._file("key") for s in (store, other))
        one.write_bytes(another.read_bytes())
        assert store.load("key") is None
        one.write_bytes(store._file("key 2").read_bytes())
        assert store.load("key") is None

    def test_damaged_code_is_compiled_again_and_never_run(self, folder):
        """Machine code and intermediate code; a process that ran damaged code could end without a word."""
        compiled()
        number = os.fork()
        if number == 0:
            status = 1
            try:
                self.flip_and_compile(folder, 20)
                status = 0
            finally:
                os._exit(status)
        assert os.waitpid(number, 0)[1] == 0

    @staticmethod
    def flip_and_compile(folder, times):
        random = chance.Random(1)
        files = sorted(folder.rglob("*.code"))
        assert len(files) == 3
        for _ in range(times):
            file = random.choice(files)
            data = bytearray(file.read_bytes())
            for _ in range(random.choice((1, 1, 2, 100))):
                data[random.randrange(len(data))] ^= 1 << random.randrange(8)
            if random.random() < 0.3:
                del data[random.randrange(len(data)) :]
            file.write_bytes(data)
            linking._dispatchers.clear()
            hits = compiled()
            # What it calls is machine code of its own.
            assert hits == (0 if file.parent.name == folder_of("outer") else 1)
            linking._dispatchers.clear()
            assert compiled() == 1

    @pytest.mark.usefixtures("folder")
    def test_what_names_a_class_that_has_gone_is_compiled_again(self, monkeypatch):
        store = Store("name")
        store.save("key", small_program.Numbers(1, 2.0))
        monkeypatch.delattr(small_program, "Numbers")
        assert store.load("key") is None


def dispatcher_of(function):
    """Dispatcher of a function that this process has linked, by its name."""
    (found,) = (d for d in linking._dispatchers.values() if d.py_func.__name__ == function)
    return found


def folder_of(function):
    """Name of the folder of its machine code."""
    return linking._stores[id(dispatcher_of(function))][0].folder.name


def doubled(x):
    return 2.0 * x


def tripled(x):
    return 3.0 * x


class Intruder:
    """Whoever loads it runs what it says."""

    def __init__(self, file):
        self.file = file

    def __reduce__(self):
        return Path.touch, (self.file,)


def belongs_to_somebody(path, monkeypatch):
    """Let a file belong to somebody else, or this process to another user."""
    if IS_ROOT:
        os.chown(path, SOMEBODY, -1)
    else:
        monkeypatch.setattr(os, "geteuid", lambda: SOMEBODY)


class TestOwners:
    @pytest.mark.parametrize("mode", [0o020, 0o002], ids=["group", "others"])
    @pytest.mark.parametrize("which", ["root", "folder", "file"])
    def test_what_others_may_write_to_is_not_used(self, folder, which, mode, caplog, forget):
        assert link(swapped_by_hand)((1.0, 2.0)) == (2.0, 1.0)
        (file,) = folder.rglob("*.code")
        path = {"root": folder, "folder": file.parent, "file": file}[which]
        path.chmod(path.stat().st_mode | mode)
        # A file of their own, sound in itself.
        wrong = folder.parent / "run by an intruder"
        f = link(swapped_by_hand)
        (store,) = linking._stores[id(f)]
        key = f.signatures[0]
        caching._write(file, pickle.dumps(((file.parent.name, key), Intruder(wrong))))
        if which == "file":
            file.chmod(0o600 | mode)
        with caplog.at_level(logging.INFO, "foamprb"):
            for _ in range(2):
                forget()
                again = link(swapped_by_hand)
                assert store.load(key) is None
                assert again((1.0, 2.0)) == (2.0, 1.0)
                assert not again.stats.cache_hits
                if which == "file":
                    # What is compiled takes its place.
                    file.chmod(0o600 | mode)
        assert not wrong.exists()
        assert [record.getMessage() for record in caplog.records] == [
            f"The compiled code in {folder} is not used: others may write to {path} (chmod go-w helps)"
        ]

    @pytest.mark.parametrize("which", ["root", "folder", "file"])
    def test_what_belongs_to_another_user_is_not_used(self, folder, which, caplog, monkeypatch, forget):
        assert link(swapped_by_hand)((1.0, 2.0)) == (2.0, 1.0)
        (file,) = folder.rglob("*.code")
        path = {"root": folder, "folder": file.parent, "file": file}[which]
        belongs_to_somebody(path, monkeypatch)
        forget()
        again = link(swapped_by_hand)
        assert again((1.0, 2.0)) == (2.0, 1.0)
        assert not again.stats.cache_hits
        assert is_compiled(again)
        (record,) = caplog.records
        assert re_path(record) == str(path) or not IS_ROOT
        assert record.levelno == logging.WARNING

    @pytest.mark.usefixtures("folder")
    def test_nothing_is_said_of_a_cache_that_is_the_users(self, caplog, forget):
        with caplog.at_level(logging.INFO, "foamprb"):
            assert compiled() == 0
            forget()
            assert compiled() == 1
        assert not caplog.records

    def test_nobody_else_may_write_to_what_is_made(self, folder, monkeypatch):
        monkeypatch.setattr(os, "geteuid", lambda: max(1, os.getuid()))
        before = os.umask(0)
        try:
            Store("name").save("key", 1)
        finally:
            os.umask(before)
        (file,) = folder.rglob("*.code")
        assert [stat.S_IMODE(path.stat().st_mode) for path in (folder, file.parent, file)] == [
            0o700, 0o700, 0o600
        ]  # fmt: skip

    @pytest.mark.skipif(not IS_ROOT, reason="only root can do as another user")
    def test_what_root_prepared_others_use(self, folder):
        """As in a container's image: whoever runs it can read the cache and not write to it."""
        before = os.umask(0o022)
        try:
            compiled()
        finally:
            os.umask(before)
        for parent in (folder.parent, *folder.parent.parents):
            if stat.S_IMODE(parent.stat().st_mode) & 0o001 == 0:
                parent.chmod(parent.stat().st_mode | 0o011)
        found = sorted(folder.rglob("*"))
        number = os.fork()
        if number == 0:
            status = 1
            try:
                os.setuid(SOMEBODY)
                linking._dispatchers.clear()
                status = 0 if compiled() == 1 and not os.access(folder, os.W_OK) else 2
                # Another function is compiled, and not saved.
                status = status or (0 if link(swapped_by_hand)((1.0, 2.0)) == (2.0, 1.0) else 3)
            finally:
                os._exit(status)
        assert os.waitstatus_to_exitcode(os.waitpid(number, 0)[1]) == 0
        assert sorted(folder.rglob("*")) == found

    @pytest.mark.usefixtures("folder")
    def test_a_pipe_in_the_place_of_a_file_stops_nobody(self):
        store = Store("name")
        store.save("key", 1)
        file = store._file("key")
        file.unlink()
        os.mkfifo(file)
        assert store.load("key") is None
        store.save("key", 2)
        assert store.load("key") == 2

    @pytest.mark.usefixtures("folder")
    def test_a_folder_in_the_place_of_a_file_stops_nobody(self):
        store = Store("name")
        store.save("key", 1)
        file = store._file("key")
        file.unlink()
        file.mkdir()
        assert store.load("key") is None
        # It stays there, and what is compiled is not kept.
        store.save("key", 2)
        assert store.load("key") is None
        assert [path.name for path in file.parent.iterdir()] == [file.name]


def re_path(record):
    """The path that a warning names."""
    return record.getMessage().partition(": ")[2].partition(" belongs")[0]


class TestStages:
    """An entry serves for all stages of a name."""

    @staticmethod
    def linked(stage):
        """The small program with one of its stages."""
        return link(small_program.outer, {small_program.stage: stage})

    def found(self, stage):
        """How often the program was found in the cache, after it has given what it gives with its stage."""
        f = self.linked(stage)
        compiled, plain = small_program.example(), small_program.example()
        result = f(compiled)
        program = renamed(small_program.outer, stage=stage)
        assert result == pytest.approx(program(plain), rel=1e-13)
        np.testing.assert_allclose(compiled.values, plain.values, rtol=1e-13)
        return sum(f.stats.cache_hits.values())

    @pytest.mark.usefixtures("folder")
    def test_an_entry_with_another_stage_is_not_compiled_again(self, forget):
        assert self.found(small_program.stage) == 0
        for _ in range(2):
            assert self.found(small_program.another_stage) == 1
            forget()
            assert self.found(small_program.stage) == 1

    def test_it_is_compiled_when_its_stage_is(self, folder, forget):
        assert self.found(small_program.stage) == 0
        f = self.linked(small_program.another_stage)
        assert not is_compiled(f)
        f(small_program.example())
        forget()
        assert is_compiled(self.linked(small_program.another_stage))
        for file in folder.rglob("*.code"):
            if b"another_stage" in file.read_bytes():
                file.unlink()
        assert not is_compiled(self.linked(small_program.another_stage))
        forget()
        assert self.found(small_program.another_stage) == 1

    @pytest.mark.usefixtures("folder")
    def test_stages_of_the_same_name_are_told_apart(self, forget):
        """Two copies of a function with other formulas in them, in both orders."""
        by_two, by_three = (traced(renamed(small_program.formed, formula=f)) for f in (doubled, tripled))
        for one, other in ((by_two, by_three), (by_three, by_two)):
            hits = []
            for _ in range(2):
                first, second = (renamed(small_program.calling, formed=stage) for stage in (one, other))
                f = link(renamed(small_program.twice, one=first, other=second))
                values = np.ones(small_program.LANES)
                f(values)
                # x -> 2x + 1 and x -> 3x + 1 in their order.
                np.testing.assert_array_equal(values, 10.0 if one is by_two else 9.0)
                hits.append(sum(f.stats.cache_hits.values()))
                forget()
            assert hits == [0, 1]

    @pytest.mark.usefixtures("folder")
    def test_a_stage_that_a_known_function_calls_is_there_for_another_entry(self, forget):
        """The function is found in the cache; its stage is called by nothing else."""
        hits = []
        for entry, result in ((small_program.calls_once, 3.0), (small_program.calls_again, 7.0)) * 2:
            f = link(entry, {small_program.formula: doubled})
            values = np.ones(small_program.LANES)
            f(values)
            np.testing.assert_array_equal(values, result)
            hits.append(sum(f.stats.cache_hits.values()))
            # In another process nothing else has made its machine code.
            assert dispatcher_of("formed").signatures
            forget()
        assert hits == [0, 0, 1, 1]

    @pytest.mark.usefixtures("folder")
    def test_loops_of_one_process_keep_their_stages(self, forget):
        """The code of both is that of the first, with a function of its own that calls a stage."""
        stages = [traced(renamed(small_program.formed, formula=f)) for f in (doubled, tripled)]
        for _ in range(2):
            results = []
            for stage in stages:
                values = np.ones(small_program.LANES)
                link(small_program.calls_once, {small_program.formed: stage})(values)
                results.append(values[0])
            assert results == [3.0, 4.0]
            forget()

    def test_what_is_kept_of_an_entry_names_no_stage(self, folder):
        self.found(small_program.stage)
        entry, stage = (
            dispatcher_of(name).py_func.__qualname__.rpartition("_")[2] for name in ("outer", "stage")
        )
        (file,) = (folder / folder_of("outer")).glob("*.code")
        kept, named = file.read_bytes(), linking.key_of(["small_program.stage"])
        keys = entry, folder_of("outer"), stage, named
        assert [key.encode() in kept for key in keys] == [False, True, False, True]


class TestProcessors:
    def test_code_of_another_processor_is_not_used(self, folder, monkeypatch, forget):
        """A home may be shared by many machines."""
        assert compiled() == 0
        monkeypatch.setattr(linking, "_compiler", lambda **_: "another processor")
        forget()
        assert not is_compiled(link(small_program.outer))
        assert compiled() == 0
        monkeypatch.undo()
        monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(folder))
        monkeypatch.setattr(linking, "_dispatchers", {})
        assert is_compiled(link(small_program.outer))
        assert compiled() == 1

    def test_numba_may_be_told_which_processor_it_is(self, tmp_path, monkeypatch):
        """Both what numba asks of the processor and what its user says are in the key."""
        for name in ("NUMBA_CPU_NAME", "NUMBA_CPU_FEATURES", processor.SWITCH):
            monkeypatch.delenv(name, raising=False)
        assert said(start(tmp_path)) == [NOT_FOUND]
        assert said(start(tmp_path, NUMBA_CPU_NAME="generic")) == [NOT_FOUND]
        assert said(start(tmp_path, NUMBA_CPU_FEATURES="")) == [NOT_FOUND]
        assert said(start(tmp_path)) == [FOUND]

    @pytest.mark.skipif(platform.machine() != "x86_64", reason="other processors have one level")
    def test_processors_of_a_level_share_code(self, tmp_path):
        """Code of all features of this processor has another key, and each level is one."""
        assert said(start(tmp_path, FOAMPRB_CPU="x86-64")) == [NOT_FOUND]
        assert said(start(tmp_path, FOAMPRB_CPU="native")) == [NOT_FOUND]
        assert said(start(tmp_path, FOAMPRB_CPU="x86-64")) == [FOUND]

    @pytest.mark.parametrize(
        ("machine", "features", "levels"),
        [
            ("x86_64", "sse4.2 avx", ["x86-64"]),
            ("x86_64", "avx avx2 bmi bmi2 f16c fma lzcnt movbe avx512f", ["x86-64", "x86-64-v3"]),
            ("aarch64", "neon", ["arm64"]),
        ],
    )
    def test_a_processor_between_two_levels_counts_as_the_lower(self, machine, features, levels, monkeypatch):
        monkeypatch.setattr(platform, "machine", lambda: machine)
        assert list(processor._levels(set(features.split()))) == levels

    def test_an_unknown_level_is_reported(self, monkeypatch):
        for name in ("CPU_NAME", "CPU_FEATURES"):
            monkeypatch.setattr(numba.config, name, None)
        monkeypatch.setenv(processor.SWITCH, "i486")
        with pytest.raises(InputError, match=r"^FOAMPRB_CPU is i486; allowed on this machine: .*, native$"):
            processor.processor.__wrapped__()


class TestSupplied:
    def test_code_of_the_package_serves_an_empty_cache(self, tmp_path):
        """A process reads it there and writes nothing; code for another level is not used."""
        supplied, cache = tmp_path / "supplied", tmp_path / "cache"
        assert said(start(supplied)) == [NOT_FOUND]
        assert said(start(cache, SUPPLIED=str(supplied))) == [FOUND]
        assert not cache.exists()
        assert said(start(cache, SUPPLIED=str(supplied), NUMBA_CPU_NAME="generic")) == [NOT_FOUND]


class TestSpace:
    def test_two_processes_that_compile_at_once_leave_one_file(self, tmp_path):
        both = [start(tmp_path) for _ in range(2)]
        for process in both:
            (line,) = said(process)
            assert " (3.0, -5.0) True " in line
        (file,) = (path for path in tmp_path.rglob("*") if path.is_file())
        assert file.suffix == ".code"
        assert said(start(tmp_path)) == [FOUND]

    def test_a_full_disk_costs_the_compilation_and_one_line(self, tmp_path):
        def no_space():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))

        reason = "File too large"
        for _ in range(2):
            assert said(start(tmp_path, no_space)) == [
                f"The compiled code in {tmp_path} is not complete: {reason}",
                "False (3.0, -5.0) True 0",
            ]
        assert not [path for path in tmp_path.rglob("*") if path.is_file()]

    def test_a_cache_that_cannot_be_made_costs_the_compilation(self, folder, caplog):
        folder.write_text("a file where the folder would be")
        with caplog.at_level(logging.INFO, "foamprb"):
            f = link(swapped_by_hand)
            assert f((1.0, 2.0)) == (2.0, 1.0)
        assert is_compiled(f)
        (record,) = caplog.records
        assert record.getMessage() == f"The compiled code in {folder} is not complete: File exists"
