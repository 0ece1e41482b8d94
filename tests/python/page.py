"""What doc/python.md shows: its blocks of Python run one after the other, and print what the blocks of text after them say."""
import contextlib
import io
import pathlib
import re
import unittest

PAGE = pathlib.Path(__file__).resolve().parents[2] / "doc" / "python.md"


class Page(unittest.TestCase):
    def test_blocks(self):
        blocks = re.findall(r"^```(python|text)\n(.*?)^```", PAGE.read_text(encoding="utf-8"), re.MULTILINE | re.DOTALL)
        said, names = None, {}
        for kind, block in blocks:
            if kind == "python":
                with contextlib.redirect_stdout(io.StringIO()) as output:
                    exec(compile(block, str(PAGE), "exec"), names)
                said = output.getvalue()
            else:
                self.assertEqual(said, block)
        self.assertGreater(len(blocks), 4)

    def test_first_study_takes_twenty_lines(self):
        study = PAGE.read_text(encoding="utf-8").split("```python\n")[1].split("```")[0]
        self.assertLessEqual(len([line for line in study.splitlines() if line.strip()]), 20)


if __name__ == "__main__":
    unittest.main()
