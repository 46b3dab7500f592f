"""Random specs of all features, the same for the same seed, through all commands; run as a script, as many as asked.

Each command is given less memory than it takes by itself, about as much, and a little more. Whatever it says, it may take a
tenth more than it was given, and what the program takes before it can refuse.
"""

import argparse
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile

MEBI = 2**20
# The kernel counts what stood in a process before a program was started in it, so a small one starts the program.
MEASURE = """
import os, sys
quiet = [(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0), (os.POSIX_SPAWN_OPEN, 2, sys.argv[1], os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)]
child = os.posix_spawn(sys.argv[2], sys.argv[2:], os.environ, file_actions=quiet)
_, status, usage = os.wait4(child, 0)
print(os.waitstatus_to_exitcode(status), usage.ru_maxrss)
"""
# What the promise leaves room for.
PERMITTED = 1.1


def measured(*command, errors=os.devnull):
    """Exit code, and the most that the program held in memory. @param errors where its standard error goes"""
    line = [sys.executable, "-I", "-S", "-c", MEASURE, str(errors), *map(str, command)]
    code, kib = map(int, subprocess.run(line, stdout=subprocess.PIPE, check=True).stdout.split())
    return code, kib * 1024


def _state(rng, i, points):
    """A state and its kind."""
    kind = rng.choice(["plain", "plain", "plain", "discrete", "periodic"])
    step = rng.choice([0.1, 0.25, 0.5, 1])
    state = {"name": f"x{i}", "outside": rng.choice(["unsafe", "unsafe", "saturate", "safe"])}
    if kind == "periodic":
        return {**state, "lower": 0, "upper": round(points * step, 3), "count": points, "outside": "periodic"}, kind
    if kind == "discrete":
        return {**state, "lower": 0, "upper": min(points, 4) - 1, "step": 1, "discrete": True, "outside": "saturate"}, kind
    half = round((points // 2) * step, 3)
    state.update(lower=-half, upper=half, step=step)
    if rng.random() < 0.15:
        state["measurement_error"] = step / 4
    return state, kind


def random_spec(seed):
    """Whatever can be asked, mostly small; some are refused for what shows only when posts are looked for."""
    rng = random.Random(seed)
    states, kinds = rng.choice([1, 2, 2, 3, 3, 4]), []
    agents = rng.choice([1, 2, 2, 3, 3, 4, 5])
    points = {1: [50, 3000, 60000], 2: [15, 60, 250], 3: [7, 15, 41], 4: [5, 9, 13]}[states]
    spec = {"coordreq": 1, "name": f"r{seed}", "states": []}
    for i in range(states):
        state, kind = _state(rng, i, rng.choice(points))
        spec["states"].append(state)
        kinds.append(kind)
    names = [state["name"] for state in spec["states"]]
    continuous = rng.random() < 0.5
    spec["inputs"] = [{"name": f"u{i}", "values": rng.choice([[-1, 1], [-1, 0, 1], [0, 1], [-2, -1, 0, 1, 2]])} for i in range(agents)]
    spec["agents"] = [{"name": f"a{i}", "inputs": [f"u{i}"]} for i in range(agents)]
    disturbed = rng.random() < 0.3
    if disturbed:
        spec["disturbances"] = [{"name": "w", "lower": -0.1, "upper": 0.1}]
    equations = {}
    for i, name in enumerate(names):
        step = spec["states"][i].get("step", 0.25)
        if kinds[i] == "discrete":
            equations[name] = "0" if continuous else rng.choice([name, f"if({names[0]} > 0, 1, 0)"])
            continue
        own = f"{step}*u{rng.randrange(agents)}"
        if rng.random() < 0.4:
            other = rng.choice(names)
            own += f" + {round(rng.uniform(-0.3, 0.3), 3)}*{other}"
        if rng.random() < 0.15:
            own += f" + {round(rng.uniform(-0.2, 0.2), 2)}*sin({rng.choice(names)})"
        if disturbed and rng.random() < 0.6:
            own += " + w"
        equations[name] = own if continuous else f"{name} + {own}"
    if continuous and "unsafe" in [state["outside"] for state in spec["states"]] and rng.random() < 0.2:
        spec["states"][0]["outside"] = "stop" if kinds[0] == "plain" else spec["states"][0]["outside"]
    spec["dynamics"] = {"time": "continuous" if continuous else "discrete", "unit": "s",
                        "period": rng.choice([0.25, "1/3", 1]) if continuous else 1, "equations": equations}  # fmt: skip
    bound = {name: max(abs(state["lower"]), abs(state["upper"])) or 1 for name, state in zip(names, spec["states"])}
    spec["safe"] = " and ".join(f"{name}^2 <= {round(rng.uniform(0.5, 1.2) * bound[name] ** 2, 2)}" for name in names)
    between = continuous and "discrete" not in kinds and rng.random() < 0.3
    spec["abstraction"] = {"cells": rng.choice(["closed", "half_open"]), "safe": rng.choice(["inner", "center"]), "between_samples": between}
    spec["controller"] = {"synthesis": rng.choice(["maximal", "maximal", "maximal", "given"])}
    if rng.random() < 0.25:
        spec["controller"]["allow"] = f"u0 >= 0 or {names[0]} > 0"
    spec["coordination"] = coordination = {}
    if rng.random() < 0.5:
        coordination["partitions"] = "all"
    for key, chance, value in (("horizon", 0.3, rng.randint(1, 4)), ("convention", 0.3, True),
                               ("max_delay", 0.2, rng.randint(1, 20)), ("connection_delay", 0.2, rng.randint(1, 4))):  # fmt: skip
        if rng.random() < chance:
            coordination[key] = value
    if rng.random() < 0.25:
        kind = rng.choice([{"weakly_hard": {"misses": 1, "window": 3}}, {"burst": {"length": 3, "gap": 2}}])
        spec["network"] = {**kind, "resynthesise": rng.random() < 0.4}
    if rng.random() < 0.3:
        spec["goal"] = f"{names[0]}^2 <= {round(0.2 * bound[names[0]] ** 2, 2)}"
    if rng.random() < 0.2 and not between and not continuous:
        spec["memory"] = {"was": f"once({names[0]} > 0)"}
        spec["safe"] += f" and (was or {names[0]} <= {bound[names[0]]})"
    if rng.random() < 0.35:
        kinds_of = [{"min_delay": 1}, {"min_delay_time": 1}, {"invariant": True}]
        spec["requirements"] = [{"name": str(r), "where": f"{names[0]} <= {round(rng.uniform(-1, 1) * bound[names[0]], 2)}", **rng.choice(kinds_of)}
                                for r in range(rng.choice([1, 5, 200]))]  # fmt: skip
        for asked in spec["requirements"]:
            if coordination.get("partitions") == "all" and agents > 1 and "invariant" not in asked:
                asked["partition"] = "|".join(f"a{i}" for i in range(agents))
    spec["output"] = {key: rng.random() < 0.35 for key in ("controller", "actions", "layers", "abstraction")}
    return spec


def partition_of(spec):
    return "|".join(agent["name"] for agent in spec["agents"])


def commands(spec, folder, results, rng):
    """What can be asked of a results file."""
    point = ",".join(f"{state['name']}=0" for state in spec["states"])
    one = ["--partition", partition_of(spec)]
    return {
        "info": ["info", results],
        "query": ["query", results, "--at", point],
        "explain": ["explain", results, "--at", point, *one],
        "verify": ["verify", results, "--budget", "0.2"],
        "compare": ["compare", results, results],
        "csv": ["export", results, "--format", "csv", "-o", folder / "o.csv"],
        "projected": ["export", results, "--format", "csv", "--project", spec["states"][0]["name"] + ":min", "-o", folder / "o.csv"],
        "vtk": ["export", results, "--format", "vtk", "-o", folder / "o.vti",
                *(part for state in spec["states"][3:] for part in ("--slice", state["name"] + "=0"))],
        "scs": ["export", results, "--format", "scs", "-o", folder / "o.scs"],
        "c-header": ["export", results, "--format", "c-header", "-o", folder / "o.h", *one],
        "report": ["report", results, "-o", folder / "o.html"],
        "simulate": ["simulate", results, "--start", "random", "--runs", "20", "--steps", str(rng.choice([20, 500])), "-o", folder / "runs.h5", *one],
    }  # fmt: skip


class Promise:
    """Measures commands under limits, and keeps what broke the promise."""

    def __init__(self, program, folder):
        self.program = str(program)
        self.folder = pathlib.Path(folder)
        self.broken = []
        self.counts = {"kept": 0, "refused at once": 0, "refused late": 0}

    def run(self, *arguments):
        return measured(self.program, *arguments, errors=self.folder / "stderr")

    def check(self, label, command, limit, floor):
        """One command that may take so much. @param floor what it takes to say that this is too little"""
        code, peak = self.run(*command, "--max-memory", limit)
        said = (self.folder / "stderr").read_text(errors="replace")
        late = "than was estimated" in said
        self.counts["kept" if code != 4 else "refused late" if late else "refused at once"] += 1
        if code not in (0, 1, 4) or peak > PERMITTED * max(limit, floor):
            self.broken.append(f"{label}: limit {limit / MEBI:.1f}, peak {peak / MEBI:.1f} MiB, exit code {code}: {said.strip()[:200]}")
        return code, peak, late

    def check_one(self, label, command, rng, floor):
        """With less than it takes, about as much, and a little more."""
        threads = ("--threads", str(rng.choice([1, 2, 8, 64])))
        if command[0] not in ("info", "compare", "report"):
            command = [*command, *threads]
        code, peak = self.run(*command)
        if code not in (0, 1):
            return
        for share in rng.sample([0.6, 0.8, 0.95, 1.05, 1.3], 2):
            self.check(f"{label} {' '.join(threads)}", command, round(share * peak), floor)

    def check_spec(self, seed):
        """A random spec in all commands. @returns whether there are results"""
        rng = random.Random(seed)
        spec, results = random_spec(seed), self.folder / "r.h5"
        text = self.folder / "s.json"
        text.write_text(json.dumps(spec))
        _, floor = self.run("analyze", text, "--max-memory", "1K", "--threads", "1")
        analysis = ["analyze", text, "--quiet", "-o", results]
        self.check_one(f"{seed} validate", ["validate", text], rng, floor)
        self.check_one(f"{seed} analyze", analysis, rng, floor)
        saved = ["--checkpoint", self.folder / "saved", "--checkpoint-every", "0"]
        self.check_one(f"{seed} checkpoint", [*analysis, *saved], rng, floor)
        (self.folder / "saved").unlink(missing_ok=True)
        if self.run(*analysis)[0] not in (0, 1):
            return False
        _, floor = self.run("info", results, "--max-memory", "1K")
        for name, command in commands(spec, self.folder, results, rng).items():
            self.check_one(f"{seed} {name}", command, rng, floor)
        results.unlink()
        return True


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--specs", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="number of the first spec")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        promise = Promise(options.program.resolve(), folder)
        told = analysed = 0
        for seed in range(options.first, options.first + options.specs):
            analysed += promise.check_spec(seed)
            for line in promise.broken[told:]:
                print(line, flush=True)
            told = len(promise.broken)
    print(json.dumps({"specs": options.specs, "analysed": analysed, **promise.counts, "broken": told}))
    return 1 if told else 0


if __name__ == "__main__":
    os.environ.setdefault("LC_ALL", "C.UTF-8")
    sys.exit(main())
