"""`init` writes a spec that runs as it is, and with each of its optional parts."""

import json
import re
import unittest

from program import ROOT, Case, without_comments


class Cases(Case):
    def init(self, *arguments):
        result = self.run_program("init", *arguments)
        self.assertEqual((result.returncode, result.stderr), (0, b""))
        return result.stdout.decode()

    def test_it_runs(self):
        text = "spec.json is written. Next:\n  coordreq validate spec.json\n  coordreq analyze spec.json\n"
        self.assertEqual(self.init(), text)
        self.assertEqual(self.run_program("validate", "spec.json").stderr, b"")
        summary = self.analyze("spec.json")
        self.assertEqual((summary["name"], summary["output"]), ("spec", "spec.h5"))
        self.assertTrue(summary["requirements"][0]["holds"])
        self.assertEqual(summary["partitions"][0]["max_delay_time"], 9)
        self.assertEqual(self.run_program("verify", "spec.h5", "--strict").returncode, 0)

    def test_optional_parts_run(self):
        text = self.init("-")
        optional = re.findall(r"(?m)^ *//\? (\"(\w+)\".*)$", text)
        self.assertEqual([key for _, key in optional], ["disturbances", "coordination", "network"])
        for line, key in optional:
            with self.subTest(key=key):
                taken = text.replace("//? " + line, line)
                self.assertNotEqual(taken, text)
                self.write("spec.json", taken)
                self.assertIn(key, json.loads(without_comments(taken)))
                self.assertEqual(self.analyze("spec.json")["name"], "spec")

    def test_schema_for_editors(self):
        path = json.loads(without_comments(self.init("-")))["$schema"].removeprefix("file://")
        with open(path, encoding="utf-8") as schema, open(ROOT / "lib/spec/schema.json", encoding="utf-8") as own:
            self.assertEqual(schema.read(), own.read())

    def test_names(self):
        for file, name in (("platoon.json", "platoon"), ("my own (1).json", "my_own__1_"), ("-a.json", "spec-a"), ("é", "__")):
            with self.subTest(file=file):
                self.init(f"./{file}")
                self.assertEqual(json.loads(without_comments((self.folder / file).read_text()))["name"], name)
                self.assertEqual(self.run_program("validate", f"./{file}").returncode, 0)

    def test_json_and_quiet(self):
        self.assertEqual(json.loads(self.init("a.json", "--json")), {"output": "a.json"})
        self.assertEqual(self.init("b.json", "--quiet"), "")
        self.assertEqual(self.files(), ["a.json", "b.json"])

    def test_nothing_is_overwritten(self):
        message = "the file is there already, expected the name of a new one"
        self.write("spec.json", "mine")
        (self.folder / "link.json").symlink_to("nowhere")
        self.assert_fails(2, f"{message} (spec.json)", "init")
        self.assert_fails(2, f"{message} (link.json)", "init", "link.json")
        self.assert_fails(2, f"{message} (.)", "init", ".")
        self.assertEqual((self.folder / "spec.json").read_text(), "mine")

    def test_folder_that_is_not_there(self):
        self.assert_fails(5, "the folder does not exist (no)", "init", "no/spec.json")


if __name__ == "__main__":
    unittest.main()
