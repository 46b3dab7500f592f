"""What users typed, as error lines repeat it: on one line, of a length that can be read."""

import unittest

from program import SPEC, Case

LONG = "x" * 29_000
BLANKS = "x " * 14_000


class Cases(Case):
    def commands(self, text):
        """Command lines with the text wherever there may be one."""
        for command in ("validate", "info", "query", "verify", "export", "report", "completion"):
            yield command, text
        yield ("compare", "R.h5", text)
        yield (text,)
        yield ("--" + text,)
        yield ("validate", "s.json", text)
        yield ("validate", "s.json", "--" + text)
        for option in ("--threads", "--max-memory", "--output", "--junit", "--set", "--sweep", "--progress"):
            yield ("analyze", "s.json", option, text)
        for setting in (f"{text}=1", f"constants.{text}=1", f"states.{text}.step=1", f"/{text}=1", f"name.{text}=1"):
            yield ("validate", "s.json", "--set", setting)
        for setting in (f'name="{text}"', f"safe={text}", f"states.0.step={text}", f"states.0={text}", f"safe=[{text}"):
            yield ("validate", "s.json", "--set", setting)
        yield ("analyze", "s.json", "--sweep", f"states.0.step={text}")
        yield ("analyze", "s.json", "--checkpoint-every", text, "--checkpoint", "c")
        for option in ("--format", "--partition", "--slice", "--project"):
            yield ("export", "R.h5", "--format", "csv", option, text)
        yield ("export", "R.h5", "--format", "csv", "--slice", f"{text}=1")
        yield ("export", "R.h5", "--format", "csv", "--slice", f"x={text}")
        yield ("export", "R.h5", "--format", "csv", "--project", f"x:{text}")
        yield ("query", "R.h5", "--at", text)
        yield ("query", "R.h5", "--at", f"{text}=1")
        yield ("query", "R.h5", "--at", f"x=1,y={text}")
        run = ("simulate", "R.h5", "--from", "x=1,y=1", "--steps", "2")
        for option in ("--policy", "--disturbance", "--partition", "--runs", "--seed"):
            yield (*run, option, text)
        yield ("simulate", "R.h5", "--from", text, "--steps", "2")
        yield ("simulate", "R.h5", "--start", text, "--steps", "2")
        yield ("verify", "R.h5", "--sample", text)
        yield ("compare", "R.h5", "R.h5", "--tolerance", text)

    def setUp(self):
        super().setUp()
        self.write("s.json", SPEC)
        self.analyze("s.json", "-o", "R.h5")

    def test_long_texts_are_cut(self):
        for text in (LONG, BLANKS, LONG[:10_000] + "é" * 9_000):
            for arguments in self.commands(text):
                with self.subTest(arguments=[argument[:30] for argument in arguments]):
                    result = self.run_program(*arguments)
                    self.assertIn(result.returncode, (0, 2, 3, 5))  # some texts are names like others
                    for line in result.stderr.decode().splitlines():
                        self.assertLess(len(line), 1100)
                        self.assertTrue(line.startswith("coordreq: error: "))
                    self.assertNotIn(text[:201], result.stderr.decode())

    def test_bytes_that_are_no_text(self):
        for text in (b"\xff", b"a\x1b[31m\r\n", b"\xc3"):
            for arguments in self.commands("TEXT"):
                arguments = [argument.encode().replace(b"TEXT", text) for argument in arguments]
                with self.subTest(arguments=arguments):
                    result = self.run_program(*arguments)
                    self.assertIn(result.returncode, (0, 2, 3, 5))  # some texts are names like others
                    for line in result.stderr.decode().split("\n")[:-1]:  # UTF-8 throughout
                        self.assertTrue(line.startswith("coordreq: error: "), line)
                        self.assertTrue(line.isprintable(), line)

    def test_fields_of_queries(self):
        for states in (f"x,y\n1,{LONG}\n", f"{LONG},y\n", f'{{"x": 1, "y": "{LONG}"}}\n', f'{{"{LONG}": 1}}\n'):
            result = self.run_program("query", "R.h5", stdin=states.encode())
            self.assertEqual(result.returncode, 2)
            self.assertNotIn(LONG[:201], result.stderr.decode())


if __name__ == "__main__":
    unittest.main()
