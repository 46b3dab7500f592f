"""Small systems of wild magnitudes, the same for the same seed; run as a script, takes many through the program.

Coefficients from 1e-300 to 1e100, steps from 1e-12 to 1e6, periods from 1e-6 to 100, periodic states of any period. A
line for each that is not as it should be: `analyze` answers, or names the equation in one line; `verify` calls no
result wrong; no run of `simulate` contradicts it; nothing takes more than a minute of processor time. Fails if there is one.
"""

import argparse
import collections
import json
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile

LIMIT = 60  # seconds of processor time


def _number(rng, low, high):
    exponent = rng.uniform(low, high)
    if rng.random() < 0.6:
        exponent = max(low, min(high, rng.gauss(0, 2)))
    return f"{rng.choice(['', '-'])}{rng.uniform(1, 10):.3g}e{int(exponent)}"


def _term(rng, names, factors):
    a, b = rng.choice(names), rng.choice(names)
    c = _number(rng, -300, 100)
    return f"({c})*" + rng.choice(
        [a, f"{a}*{b}", f"sin({a})", f"cos({_number(rng, -3, 3)}*{a})", f"abs({a})", f"tan({a}/4)", f"{a}^2",
         f"if({a} > 0, {b}, {b})", f"if({a} > 0, 1, 1)", f"max({a}, {b})", "1", f"sign({a})", f"exp({a})", f"tanh({a})",
         f"sqrt(abs({a}))", f"log(abs({a}))", f"{a}/{b}", *factors]
    )  # fmt: skip


def wild_system(seed):
    """A spec of one or two states and about 100 cells at most."""
    rng = random.Random(seed)
    names = ["x", "y"][: rng.choice([1, 1, 2])]
    count = {1: 25, 2: 7}[len(names)]
    states = []
    for name in names:
        step = rng.uniform(1, 10) * 10.0 ** rng.randint(-12, 5) if rng.random() < 0.5 else rng.choice([0.1, 0.25, 1])
        if rng.random() < 0.25:
            half = rng.choice([1, 2, "pi", "2*pi", 0.5])
            middle = rng.choice([0, 0, -3, 7])
            lower, upper = f"{middle} - {half}", f"{middle} + {half}"
            states.append({"name": name, "lower": lower, "upper": upper, "count": count, "outside": "periodic"})
            continue
        outside = rng.choice(["unsafe", "saturate", "safe", "stop"])
        first = rng.choice([0, -count // 2, 1, -count - 1])
        states.append({"name": name, "lower": f"{first}*{step!r}", "upper": f"{first + count - 1}*{step!r}",
                       "step": f"{step!r}", "outside": outside})  # fmt: skip
    discrete = rng.random() < 0.25
    if discrete:
        for state in states:
            if state["outside"] == "stop":
                state["outside"] = "saturate"
    equations = {}
    for name in names:
        terms = [_term(rng, names, ["u", "v"]) for _ in range(rng.randint(1, 2))]
        equations[name] = " + ".join(([name] if discrete and rng.random() < 0.5 else []) + terms)
    period = 10.0 ** rng.uniform(-6, 2) if rng.random() < 0.5 else rng.choice([0.1, 0.5, 1])
    wide = abs(float(_number(rng, -12, 2)))
    noise = [{"name": "w", "lower": -wide, "upper": wide}] if rng.random() < 0.15 else []
    if noise:
        equations[names[0]] += " + w"
    return {
        "coordreq": 1,
        "name": f"wild{seed}",
        "states": states,
        "inputs": [{"name": "u", "values": [-1, 0, 1]}, {"name": "v", "values": [0, 1]}],
        "agents": [{"name": "a", "inputs": ["u"]}, {"name": "b", "inputs": ["v"]}],
        "dynamics": {"time": "discrete" if discrete else "continuous", "period": float(f"{period:.4g}"),
                     "equations": equations},
        "disturbances": noise,
        "safe": "true",
        "abstraction": {"cells": rng.choice(["closed", "half_open"]), "between_samples": not discrete and rng.random() < 0.25},
        "output": {"abstraction": rng.random() < 0.7},
    }  # fmt: skip


def complaint(program, seed, folder, limit=LIMIT):
    """@returns what happened ("answered" or "refused"), and what is not as it should be, if something is"""
    (folder / "wild.json").write_text(json.dumps(wild_system(seed)))
    results = folder / "wild.h5"
    results.unlink(missing_ok=True)

    def run(*arguments):
        done = subprocess.run([program, *arguments], capture_output=True, text=True, cwd=folder,
                              preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_CPU, (limit, limit)))  # fmt: skip
        if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            raise TimeoutError(f"took more than {limit} s: {arguments}")
        return done

    try:
        analysis = run("analyze", "wild.json", "-o", "wild.h5", "--quiet")
        errors = [line for line in analysis.stderr.splitlines() if not line.startswith("coordreq: warning: ")]
        if analysis.returncode == 3:
            named = "/dynamics/equations/" in analysis.stderr or "/states/" in analysis.stderr
            return "refused", None if errors and named else f"no equation is named: {analysis.stderr}"
        if analysis.returncode != 0:
            return "refused", f"analyze: {analysis.returncode}: {analysis.stderr}"
        verification = run("verify", "wild.h5", "--budget", "3", "--json")
        if verification.returncode != 0:
            return "answered", f"verify: {verification.returncode}: {verification.stderr}{verification.stdout[-2000:]}"
        simulation = run("simulate", "wild.h5", "--start", "random", "--runs", "3", "--steps", "4", "--quiet")
        nobody = "the invariance set is empty" in simulation.stderr
        if (simulation.returncode not in (0, 1) and not nobody) or "contradicts" in simulation.stderr:
            return "answered", f"simulate: {simulation.returncode}: {simulation.stderr}"
        return "answered", None
    except TimeoutError as error:
        return "late", str(error)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program")
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=500)
    options = parser.parse_args()
    program = str(pathlib.Path(options.program).resolve())
    happened = collections.Counter()
    complaints = 0
    with tempfile.TemporaryDirectory() as folder:
        for seed in range(options.first, options.first + options.count):
            what, wrong = complaint(program, seed, pathlib.Path(folder))
            happened[what] += 1
            if wrong:
                complaints += 1
                print(f"{seed}: {wrong}", flush=True)
    print(dict(happened), f"{complaints} complaints")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main())
