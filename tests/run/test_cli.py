"""The command line itself: help, and how it ends."""

from __future__ import annotations

import argparse
import importlib
import os
import re
import shlex
import signal
import subprocess
import sys
import time
from itertools import product
from pathlib import Path

import pytest
from paths import PIPE, ROOT
from pipe_case import copy_of_pipe, edit

from foamprb.cli import main
from foamprb.cli.main import COMMANDS as ALL
from foamprb.cli.main import GROUPS, _parser
from foamprb.cli.options import dictionary_of
from foamprb.errors import InputError

COMMANDS = ("run", "info", "compile")
# As on a user's computer, where Python buffers what it writes into a pipe.
ENVIRONMENT = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
ENVIRONMENT["PYTHONPATH"] = os.pathsep.join([str(ROOT), *sys.path])


def test_every_command_has_help(capsys):
    faults = []
    for command, word in product(("", *COMMANDS), ("-h", "-help", "--help")):
        status = main([command, word] if command else [word])
        out, err = capsys.readouterr()
        usage = out.startswith(f"usage: foamprb {command}".rstrip()) and "show this text and exit" in out
        if status or err or not usage:
            faults.append((command, word))
    assert not faults


def test_help_has_groups_and_examples_that_can_be_read(capsys):
    main(["-h"])
    out = capsys.readouterr().out
    for title, group in GROUPS.items():
        part = out.partition(f"\n{title}:\n")[2].partition("\n\n")[0]
        assert all(f"    {name} " in part for name in group)
        assert "example: foamprb " in part
    for name, command in ALL.items():
        assert (
            _parser().parse_args(shlex.split(re.sub(r" -(?=[A-Za-z]{2})", " --", command.EXAMPLE))).command
            == name
        )
        main([name, "-help"])
        out = capsys.readouterr().out
        assert f"example: foamprb {command.EXAMPLE}" in " ".join(out.split())
        assert "--" not in out


def test_help_leads_to_commands(capsys):
    """Also of a name that is an entry too."""
    for name in ("fit", "view"):
        assert main(["help", name]) == 0
        first, *others = capsys.readouterr().out.splitlines()
        assert first == f"foamprb {name}: {ALL[name].PURPOSE}. Options: foamprb {name} -help"
        assert bool(others) == (name == "view")


@pytest.mark.parametrize("name", ["/dev/null", "/dev/stdout", "pipe", ""])
@pytest.mark.parametrize(
    "command",
    ["run", "view", "report", "export", "init", "fit -measured m", "lut -diameters 1 2 -moduli 1 2"],
)
def test_devices_and_pipes_are_not_replaced(name, command, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    os.mkfifo("pipe")
    assert main([*command.split(), "-output", name]) == 2
    said = "-output: the name is empty;" if not name else f"-output: {name} is a device or a pipe;"
    assert capsys.readouterr().err.startswith(f"--> foamprb Error : {said} ")
    assert Path("pipe").is_fifo()


def test_settings_are_relative_to_the_user_or_else_to_the_case(tmp_path, monkeypatch):
    case, here = tmp_path / "case", tmp_path / "here"
    for folder, names in ((case, "ab"), (here, "bc")):
        folder.mkdir()
        for name in names:
            (folder / name).touch()
    monkeypatch.chdir(here)
    options = argparse.Namespace(case=Path("../case"), dict=None)
    assert dictionary_of(options) is None
    for name, expected in (
        ("a", case / "a"),
        ("b", here / "b"),
        ("c", here / "c"),
        ("../here/c", here / "c"),
    ):
        options.dict = Path(name)
        assert (options.case / dictionary_of(options)).resolve() == expected
    options.dict = Path("d")
    with pytest.raises(InputError, match=r"-dict d: no such file, neither here nor in the case \.\./case\."):
        dictionary_of(options)


def test_without_a_command_the_help_is_a_mistake(capsys):
    assert main([]) == 2
    assert capsys.readouterr().out.startswith("usage: foamprb")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        ("rn", "unknown command 'rn'. Did you mean 'run'?"),
        ("-versio", "foamprb has no option '-versio'. Did you mean '-version'? Try: foamprb -help"),
        ("run -thread 3", "foamprb run has no option '-thread'. Did you mean '-threads'?"),
        ("run --overwrit", "foamprb run has no option '--overwrit'. Did you mean '-overwrite'?"),
        ("view -zzzzz", "foamprb view has no option '-zzzzz'. Try: foamprb view -help"),
        ("run a", "'a' is one argument too many. Try: foamprb run -help"),
        ("run -time", "-time: expected one argument. Try: foamprb run -help"),
        ("run --time", "--time: expected one argument. Try: foamprb run -help"),
        ("run -time 1 -latestTime", "-latestTime: not allowed with argument -time. Try: foamprb run -help"),
        ("run -dry-run -estimateErrors", "-estimateErrors does not go with -parallel or -dry-run."),
    ],
)
def test_a_command_line_that_cannot_be_read_ends_with_status_2(words, message, capsys):
    """Options are named as they were typed."""
    assert main(words.split()) == 2
    assert capsys.readouterr().err.startswith(f"--> foamprb Error : {message}")


@pytest.mark.parametrize("command", ["run", "info", "view", "init", "report"])
def test_a_case_that_is_not_there_is_no_missing_file(command, tmp_path, capsys):
    assert main([command, "-case", str(tmp_path / "nowhere")]) == 1
    assert capsys.readouterr().err == f"--> foamprb Error : -case {tmp_path}/nowhere: no such folder.\n"
    (tmp_path / "file").touch()
    assert main([command, "-case", str(tmp_path / "file")]) == 1
    assert "file: is a file; the folder of a case is needed." in capsys.readouterr().err


def test_the_log_is_quiet_or_has_times(capsys):
    words = ["run", "-case", str(PIPE), "-dry-run"]
    assert main([*words, "-quiet"]) == 0
    assert capsys.readouterr().out == ""
    assert main([*words, "-verbose"]) == 0
    lines = capsys.readouterr().out.splitlines()
    times = [float(re.match(r"\[ *([0-9.]+)\] ", line)[1]) for line in lines]
    assert times == sorted(times)
    assert times[-1] > times[0]


def test_version(capsys):
    assert main(["-version"]) == 0
    assert capsys.readouterr().out.startswith("foamprb ")


def test_run_whose_log_is_closed_later_ends_quietly(tmp_path):
    case = copy_of_pipe(tmp_path)
    edit(case, r"writeInterval\s+\S+;", "writeInterval 0.0001;")
    words = [sys.executable, "-m", "foamprb", "run", "-case", str(case)]
    with subprocess.Popen(
        words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT
    ) as foamprb:
        assert foamprb.stdout is not None
        assert any(line.startswith("Time = 0.0002") for line in foamprb.stdout)
        foamprb.stdout.close()
        assert foamprb.stderr is not None
        assert foamprb.stderr.read() == ""
    assert foamprb.returncode == 128 + signal.SIGPIPE
    assert len(list((case / "postProcessing/softCloud/checkpoint").iterdir())) == 2


@pytest.mark.parametrize("words", [("info", "-case", str(PIPE)), ("run", "-case", str(PIPE), "-dry-run")])
def test_a_closed_pipe_ends_every_command_quietly(words):
    reader, writer = os.pipe()
    os.close(reader)
    try:
        done = subprocess.run(
            [sys.executable, "-m", "foamprb", *words],
            stdout=writer, stderr=subprocess.PIPE, text=True, env=ENVIRONMENT, check=False,
        )  # fmt: skip
    finally:
        os.close(writer)
    assert (done.returncode, done.stderr) == (128 + signal.SIGPIPE, "")


@pytest.mark.parametrize(("shell", "status"), [(">&-", 0), ("> /dev/full", 1)])
def test_a_closed_or_full_output_is_no_traceback(shell, status):
    command = f"exec {sys.executable} -m foamprb info -case {PIPE} {shell}"
    done = subprocess.run(["sh", "-c", command], env=ENVIRONMENT, capture_output=True, text=True, check=False)
    assert done.returncode == status
    assert done.stderr.count("\n") == status
    assert ("No space left" in done.stderr) == bool(status)


def test_an_import_is_finished_before_an_interruption(tmp_path, monkeypatch, capsys):
    """VTK crashes if the loading of its modules is interrupted."""
    text = "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(0.05)\n"
    (tmp_path / "slow_module.py").write_text(text)
    monkeypatch.syspath_prepend(tmp_path)

    def execute(_arguments):
        importlib.import_module("slow_module")
        time.sleep(1.0)

    monkeypatch.setattr("foamprb.cli.help.execute", execute)
    assert main(["help"]) == 130
    assert "stopped by the user" in capsys.readouterr().err
    assert "slow_module" in sys.modules
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def test_names_that_are_no_text_are_one_message(capsys):
    assert main(["info", "-case", "caf\udce9"]) == 1
    assert "a name that is not UTF-8" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("line", "expected"), [("foamprb rep", {"report "}), ("foamprb run --dict x --over", {"--overwrite "})]
)
def test_the_shell_completes_commands_and_options(tmp_path, line, expected):
    answer = tmp_path / "answer"
    shell = {
        "_ARGCOMPLETE": "1", "COMP_LINE": line, "COMP_POINT": str(len(line)), "_ARGCOMPLETE_IFS": "\n",
        "_ARGCOMPLETE_STDOUT_FILENAME": str(answer),
    }  # fmt: skip
    subprocess.run([sys.executable, "-m", "foamprb"], env={**ENVIRONMENT, **shell}, check=True)
    assert set(answer.read_text().split("\n")) == expected
