"""What comes first in the answers: the silence that the spec asks about, and a state where it is longest."""

import html
import json
import re
import unittest

import h5py
import numpy
from program import CONFIGS, Case, spec_with, without_comments

RULE = {"first": "u1 == -1", "second": "u2 == -1"}


def crossing(**more):
    return {**json.loads(without_comments((CONFIGS / "crossing.json").read_text())), **more}


class Cases(Case):
    def answers(self, spec):
        """The text of analyze, the lines of it, of info and of the report that say how long silence is safe, and the JSON."""
        self.write("spec.json", spec)
        text = self.run_program("analyze", "spec.json", "-o", "out.h5").stdout.decode()
        lines = re.findall(r"(?m)^  ((?:From|Stopped|The agents|All agents) .*)$", text)
        info = self.run_program("info", "out.h5").stdout.decode()
        self.assertEqual(re.findall(r"(?m)^  ((?:From|Stopped|The agents|All agents) .*)$", info), lines)
        self.assertLess(info.index(lines[0]), info.index("\naxis "))
        self.run_program("report", "out.h5", "-o", "out.html")
        page = (self.folder / "out.html").read_text()
        box = page[page.index('<div class="answer">') :]
        box = box[: box.index("</div>")]
        shown = [html.unescape(re.sub("<[^>]*>", "", part)) for part in re.findall(r"<p[^>]*>(.*?)</p>", box)]
        found = json.loads(self.run_program("analyze", "spec.json", "-o", "out.h5", "--json").stdout)
        return text, lines, shown, found

    def best(self, path):
        """The first cell with the longest finite number of steps, and that number."""
        with h5py.File(self.folder / "out.h5") as file:
            steps = file[path][0]
            finite = numpy.where(steps == numpy.iinfo(steps.dtype).max, -5, steps)
            index = numpy.unravel_index(numpy.argmax(finite), finite.shape)
            names = [name for name in json.loads(file["spec_json"][()])["states"]]
            return {own["name"]: file[own["name"]][k] for own, k in zip(names, index)}, int(finite.max())

    def words(self, state):
        return ", ".join(f"{name} = {value:.6g}" for name, value in state.items())

    def test_independent_choice_alone(self):
        _, lines, shown, found = self.answers(crossing())
        state, steps = self.best("delay")
        self.assertEqual(found["partitions"][0]["best_state"], state)
        self.assertEqual(len(lines), 1)
        self.assertIn(f"({self.words(state)}), {steps} steps ({steps} s) without coordination are safe.", lines[0])
        self.assertIn(f"{steps} s ({steps} steps)", shown[0])
        self.assertNotIn("independent choice", shown[0])

    def test_a_rule_comes_before_independent_choice(self):
        spec = crossing(silence={"actions": RULE, "then": RULE})
        text, lines, shown, found = self.answers(spec)
        entry = found["partitions"][0]
        self.assertEqual(len(lines), 2)
        self.assertIn("of silence by the communication-loss rule", lines[0])
        self.assertIn("of silence by independent choice", lines[1])
        state, steps = self.best("silence")
        if entry["silence"]["fixed_point"] > 0:
            self.assertTrue(lines[0].startswith(f"From {entry['silence']['fixed_point']:,} cells "), lines)
        if steps > 0:
            self.assertEqual(entry["silence"]["best_state"], state)
            self.assertIn(f"({self.words(state)}), {steps} step", lines[0])
        self.assertLess(text.index("safe by the rule"), text.index("\n  layers"))
        self.assertIn("by the communication-loss rule", shown[0])
        self.assertIn("by independent choice", shown[1])
        query = self.run_program("query", "out.h5", "--at", "p1=-4,v1=1,p2=-4,v2=1").stdout.decode()
        self.assertLess(query.index("\n  silence"), query.index("\n  delay"))

    def test_a_state_is_named_where_the_rule_is_safe_indefinitely_or_not_at_all(self):
        """The rule keeps its cells for ever or loses them at once: no finite number of steps is above 0."""
        still = {"a": "u == 0", "b": "v == 0"}
        _, lines, shown, found = self.answers(spec_with(silence={"actions": still, "then": still}))
        (partition,) = found["partitions"]
        self.assertLess(len(partition["silence"]["layers"]), 3)
        with h5py.File(self.folder / "out.h5") as file:
            unbounded = file["silence"][0] == numpy.iinfo(numpy.int32).max
            index = numpy.unravel_index(numpy.argmax(unbounded), unbounded.shape)
            state = {"x": file["x"][index[0]], "y": file["y"][index[1]]}
        self.assertEqual(partition["silence"]["best_state"], state)
        info = json.loads(self.run_program("info", "out.h5", "--json").stdout)
        self.assertEqual(info["partitions"][0]["silence"]["best_state"], state)
        self.assertIn(f" cells (e.g. {self.words(state)}) any number of steps of silence by the communication-loss rule is safe", lines[0])
        self.assertIn(f"(e.g. x = {state['x']:g} m, y = {state['y']:g} m)", shown[0])
        query = self.run_program("query", "out.h5", "--at", "x=1,y=1").stdout.decode()
        self.assertRegex(query, rf"\n  best state +unbounded at {re.escape(self.words(state))}\n")

    def test_own_observations_come_before_independent_choice(self):
        spec = json.loads(without_comments((CONFIGS / "blind_crossing.json").read_text()))
        _, lines, shown, found = self.answers(spec)
        self.assertEqual(len(lines), 2)
        self.assertIn("of silence with own observations only", lines[0])
        state, steps = self.best("blind_countdown")
        self.assertEqual(found["partitions"][0]["blind"]["best_state"], state if steps > 0 else None)
        self.assertIn("with own observations only", shown[0])
        query = self.run_program("query", "out.h5", "--at", "p1=-4,v1=1,p2=-4,v2=1").stdout.decode()
        self.assertLess(query.index("\n  blind delay"), query.index("\n  delay"))

    def test_a_rule_of_many_partitions_has_a_column(self):
        spec = crossing(silence={"actions": RULE, "then": RULE})
        spec["agents"] = spec["agents"] + [{"name": "third", "inputs": ["u3"]}, {"name": "fourth", "inputs": ["u4"]}]
        spec["inputs"] = spec["inputs"] + [{"name": "u3", "values": [0]}, {"name": "u4", "values": [0]}]
        spec["silence"]["actions"] = spec["silence"]["then"] = {**RULE, "third": "u3 == 0", "fourth": "u4 == 0"}
        spec["coordination"] = {"partitions": "all"}
        self.write("spec.json", spec)
        text = self.run_program("analyze", "spec.json", "-o", "out.h5").stdout.decode()
        self.assertRegex(text, r"(?m)^partition +safe by the rule indefinitely +F +unbounded")


if __name__ == "__main__":
    unittest.main()
