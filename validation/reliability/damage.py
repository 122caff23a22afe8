"""The trials of torture.py that damage one file of a run folder, and the commands that read the folder."""
import random
import shutil
import signal

import trial

HOW = ["cut", "flipped", "removed"]
FINISHED = ["steady", "inflate", "sweep", "openfoam"]
INTERRUPTED = {"steady": 0.6, "inflate": 0.6, "sweep": 0.75, "openfoam": 0.6}  # killed at this share of its writes

# Commands that read the folder {run} of each command, other than the command itself; files in the new folder {out} are compared.
READERS = {
    "steady": ["descent {run} --mass 4 --json", "export json {run}", "load {case} --mass 4 --speed 25 --steady {run} --json --out {out}",
               "inflate {case} --steady {run} --check", "report {run} --out {out}/report.html", "report {run}",
               "photogrammetry {image} --run {run} --json --out {out}"],
    "inflate": ["load {case} --mass 4 --speed 25 --opening {run} --json --out {out}", "report {run} --out {out}/report.html", "report {run}"],
    "sweep": ["report {run} --out {out}/report.html", "report {run}", "report {run}/speed_m_s=20 {run}/speed_m_s=22 --out {out}/report.html"],
    "openfoam": ["descent {run} --mass 4 --json"],
}
IMAGE = trial.ROOT / "validation/ojf/stratos-iv-images.toml"


def spoil(path, how, rng):
    if how == "removed":
        path.unlink()
        return
    text = bytearray(path.read_bytes())
    if how == "cut":
        path.write_bytes(text[:len(text) // 2])
    elif text:
        text[rng.randrange(len(text))] ^= 1
        path.write_bytes(text)


def given_by(bench, words, run, out):
    """Exit code, result (output and files in {out}), and standard error of a command."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    arguments = [word.format(case=bench.case, run=run, out=out, image=IMAGE) for word in words.split()]
    code, text, err = bench.run([str(bench.program), *arguments])
    left = {name: text.replace(str(run).encode(), b"RUN") for name, text in trial.contents(out).items()}
    if words == "report {run}":
        left = trial.contents(run).get("report.html")
    return code, (text.replace(str(run), "RUN").replace(str(out), "OUT"), left), err


def readers(bench, name):
    """words -> result of the command with the undisturbed folder; made once."""
    with bench.lock:
        return readers_alone(bench, name)


def readers_alone(bench, name):
    key = f"readers of {name}"
    if key not in bench.known:
        run = bench.folder(f"read-{name}") / "out"
        shutil.copytree(bench.undisturbed(name)[0], run)
        bench.known[key] = {}
        for words in READERS[name]:
            code, given, err = given_by(bench, words, run, run.parent / "made")
            if code not in (0, trial.NOT_CONVERGED):
                raise SystemExit(f"{words}: the undisturbed folder gives exit code {code}: {trial.last_line(err)}")
            bench.known[key][words] = code, given
    return bench.known[key]


def judge(words, code, wanted, same, err, file, run):
    """None, or the fault."""
    if code == wanted:
        return "" if same else f"{words}: gives something else without a word ({trial.last_line(err)})"
    named = file.rsplit("/", maxsplit=1)[-1] in err or str(run) in err
    if code in (2, 3, 6, 7) and named:
        return ""
    return f"{words}: exit code {code}: {trial.last_line(err)}"


def finished(bench, name, file, how):
    run = bench.folder("trial") / "out"
    whole, wanted, _, _ = bench.undisturbed(name)
    shutil.copytree(whole, run)
    spoil(run / file, how, random.Random(f"{name} {file} {how}"))
    spoiled = {}
    for path in [run / file] if (run / file).exists() else []:
        spoiled = {path: path.read_bytes()}
    wrong, noticed = [], 0
    for words, (code_before, before) in readers(bench, name).items():
        for path, text in spoiled.items():  # a report is written again by the command before
            path.write_bytes(text)
        code, given, err = given_by(bench, words, run, run.parent / "made")
        noticed += code != code_before
        wrong.append(judge(words, code, code_before, given == before, err, file, run))
    code, _, err = bench.run(bench.command(name, run), trial.FASTER.get(name))
    noticed += code != wanted
    # The run has continued from the case of OpenFOAM and the checkpoint; this command does not use them.
    unlike = trial.differences(run, whole, lambda n: "checkpoint" in n or "flow/" in n)
    wrong.append(judge("again", code, wanted, not unlike, err + " " + " ".join(unlike[:5]), file, run))
    wrong = [text for text in wrong if text]
    return {"ok": not wrong, "noticed": noticed, "said": "; ".join(wrong)}


def interrupted_folder(bench, name):
    """The folder of a run that was killed in the middle; made once."""
    with bench.lock:
        return interrupted_folder_alone(bench, name)


def interrupted_folder_alone(bench, name):
    key = f"interrupted {name}"
    if key not in bench.known:
        run = bench.folder(f"half-{name}") / "out"
        at = int(INTERRUPTED[name] * len(bench.undisturbed(name)[3]))
        code, _, _ = bench.run(bench.command(name, run), {**trial.FASTER.get(name, {}), "TORTURE_ROOT": str(run), "TORTURE_AT": str(at), "TORTURE_DO": "kill"})
        if code != -signal.SIGKILL:
            raise SystemExit(f"{name}: was not killed but ended with {code}")
        bench.known[key] = run
    return bench.known[key]


def interrupted(bench, name, file, how):
    run = bench.folder("trial") / "out"
    shutil.copytree(interrupted_folder(bench, name), run)
    spoil(run / file, how, random.Random(f"{name} {file} {how}"))
    whole, wanted, _, _ = bench.undisturbed(name)
    # For the finished runs of a sweep, as in finished().
    ended = [folder.name for folder in run.iterdir() if (folder / ".ripstop/seal").exists()]
    code, _, err = bench.run(bench.command(name, run), trial.FASTER.get(name))
    past = tuple(f"{name}/checkpoint/" for name in ended)
    unlike = trial.differences(run, whole, lambda n: n.startswith(past)) if code == wanted else []
    wrong = judge("again", code, wanted, not unlike, err + " differ: " + ", ".join(unlike[:8]), file, run)
    if not wrong and code != wanted and "--fresh" in err:  # the advice is correct
        code, _, err = bench.run([*bench.command(name, run), "--fresh"], trial.FASTER.get(name))
        unlike = trial.differences(run, whole) if code == wanted else ["all"]
        if unlike:
            wrong = f"--fresh: exit code {code}, differ: {', '.join(unlike[:8])}; {trial.last_line(err)}"
        return {"ok": not wrong, "noticed": 1, "said": wrong}
    return {"ok": not wrong, "noticed": int(code != wanted), "said": wrong}


def files(folder):
    """Except temporary ones, whose name contains the process number."""
    return sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file() and not path.name.endswith(".tmp"))


def trials(bench, rng):
    listed = []
    for name in FINISHED:
        for file in files(bench.undisturbed(name)[0]):
            listed += [(f"damage finished {name} {file} {how}", name, finished, (name, file, how)) for how in HOW]
    for name in INTERRUPTED:
        for file in files(interrupted_folder(bench, name)):
            listed += [(f"damage interrupted {name} {file} {how}", name, interrupted, (name, file, how)) for how in HOW]
    rng.shuffle(listed)
    return listed
