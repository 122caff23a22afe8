"""The tables of mutants.py: the sample with the named mutants, and fresh mutants, for which no test was written."""
import collections
import json
import pathlib

import tables

NUMBER = 400  # mutants of the sample
MOST = 300  # longest time of the tests of a mutant [s]
SLOWEST = 60  # a test that takes longer is left out [s]


def judged():
    """Reviews of survivors: {name: [equivalent, harmless or hole, reason]}."""
    return json.loads((pathlib.Path(__file__).parent / "judged.json").read_text())


def write_one(name, title, mutants, dropped, log, command, of_what):
    """Table of pairs (number, mutant); it is not changed where less than half of them were tested."""
    judgements, rows, total, survivors, days, unmet = judged(), {}, collections.Counter(), [], set(), 0
    for number, mutant in mutants:
        count = rows.setdefault(mutant["room"], collections.Counter())
        entry = log.get((mutant["name"], mutant["of"]))
        if number in dropped or not entry:
            count["dropped" if number in dropped else "to do"] += 1
            continue
        days.add(entry["day"])
        count["run"] += 1
        if entry["caught"]:
            count["caught"] += 1
            continue
        kind, reason = judgements.get(mutant["name"], ["not judged", ""])
        count[kind], unmet = count[kind] + 1, unmet + (kind in ("not judged", "hole") and entry["left_out"] > 0)
        survivors.append((kind, mutant["path"].removeprefix("src/ripstop/"), str(mutant["m"].line), reason, mutant["m"]))
    for count in rows.values():
        total.update(count)
    if 2 * total["run"] < len(mutants):
        return

    def row(room, c):
        held = c["run"] - c["equivalent"] - c["harmless"]
        share = f"{100 * c['caught'] / held:.0f} %" if held else ""
        return [room, str(c["run"]), str(c["equivalent"]), str(c["harmless"]), str(held), str(c["caught"]), share]

    def code(text):
        text = " ".join(text.split()).replace("|", "\\|")
        return f"`{text if len(text) < 90 else text[:87] + '...'}`"

    lines = [f"{len(mutants)} {of_what}, {total['dropped']} of them do not compile, {total['to do']} were not run. The tests of Python and "
             "of the browser, and tests that take longer than the limit of the command, were not used.", ""]
    lines += tables.table(["room", "run", "equivalent", "harmless", "neither", "detected", "detected, share of neither"],
                          [*(row(room, rows[room]) for room in sorted(rows)), row("all", total)])
    lines += [f"{unmet} survivors that are not reviewed as equivalent or harmless were not run by all tests that execute their line.", ""] if unmet else []
    lines += ["## Survivors", "", "*Equivalent*: no input gives another result. *Harmless*: the change affects only speed, the text of a message, a tie, or an arbitrary limit. *Hole*: a test is missing.", ""]
    lines += tables.table(["place", "changed code", "original code", "review", "reason"],
                          [[f"{path}:{line}", code(m.mutant) if m.mutant else f"no `{m.text}`", code(m.text), kind, reason]
                           for kind, path, line, reason, m in sorted(survivors, key=lambda s: (s[0] != "hole", s[0], s[1], int(s[2])))])
    tables.write(name, title, command, [{"started": day, "processor": tables.machine()} for day in sorted(days)], lines)
    held = total["run"] - total["equivalent"] - total["harmless"]
    print(f"{name}: {total['run']} run, {held} neither equivalent nor harmless, {total['caught']} caught, {total['not judged']} not judged")


def write_both(numbered, asked, dropped, log, options):
    usual = {"number": NUMBER, "after": options.number, "fresh": 0, "count": 0, "skip": 0, "most": MOST, "slowest": SLOWEST}
    given = "".join(f" --{name} {getattr(options, name):g}" for name, value in usual.items() if getattr(options, name) != value)
    command = "make mutants" + (f' MUTANTS="{given.strip()}"' if given else "")
    write_one("mutants", "Changed sources (mutants) and the tests that detect them", [(n, m) for n, m in numbered if m["name"] in asked], dropped,
                log, command, "sampled and named mutants")
    write_one("mutants-fresh", "Changed sources (mutants) for which no test was written", [(n, m) for n, m in numbered if m["name"] not in asked],
                dropped, log, command, f"mutants after the first {options.after} in the order of the sample")
