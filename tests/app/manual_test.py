#!/usr/bin/env python3
"""usage: tests/app/manual_test.py FATHOM
Man pages and completions that `FATHOM manual` writes: man, mandoc and each shell, as far as they are here, take them without a complaint,
and the shells offer what can be typed next."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = sys.argv.pop(1)
SHARE = Path(tempfile.mkdtemp())

BASH = r"""
source "$1"; shift
compopt() { :; }
COMP_WORDS=(fathom "$@"); COMP_CWORD=$#
_fathom
printf '%s\n' "${COMPREPLY[@]}"
"""
# zsh completes in its line editor alone: a shell that types into another.
ZSH = r"""
zmodload zsh/zpty
zpty inner zsh -f -i
read_inner() { while zpty -r -t inner line 2>/dev/null; do out+=$line; done; }
zpty -w inner "PS1=; fpath=(${1:h} \$fpath); autoload -U compinit; compinit -u -D; LISTMAX=10000; LINES=300; COLUMNS=80; zstyle ':completion:*' list-colors; zstyle ':completion:*' menu false; print READ''Y"
for i in {1..200}; do zpty -r -m inner line '*READY*' && break; sleep 0.1; done
zpty -n -w inner "$2"$'\t\x04'
for i in {1..30}; do sleep 0.1; read_inner; done
print -r -- "$out"
"""


def run(*words):
    return subprocess.run(words, capture_output=True, text=True, cwd=SHARE)


def having(program):
    return unittest.skipUnless(shutil.which(program), f"no {program}")


class Manual(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        subprocess.run([PROGRAM, "manual", "-o", SHARE], check=True)
        cls.pages = sorted((SHARE / "man/man1").iterdir())

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(SHARE)

    def test_every_command_has_a_page(self):
        help_text = run(PROGRAM, "--help").stdout
        commands = re.findall(r"^  ([a-z]+) ", help_text.split("Subcommands:")[1], re.M)
        self.assertIn("capture", commands)
        self.assertEqual({page.name for page in self.pages}, {"fathom.1"} | {f"fathom-{name}.1" for name in commands})

    @having("man")
    def test_man_has_no_warnings(self):
        for page in self.pages:
            shown = subprocess.run(["man", "--warnings=w", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page], capture_output=True, text=True,
                                   env=os.environ | {"MANWIDTH": "100", "LC_ALL": "C.UTF-8"})
            self.assertEqual((shown.stderr, shown.returncode), ("", 0), page.name)

    @having("mandoc")
    def test_mandoc_has_no_warnings(self):
        for page in self.pages:
            complaints = run("mandoc", "-T", "lint", "-W", "warning", page).stdout.splitlines()
            # A page carries no date: the same program writes the same pages on any day.
            self.assertEqual([line for line in complaints if "missing date" not in line], [], page.name)

    @having("man")
    def test_a_page_says_what_help_says(self):
        shown = subprocess.run(["man", "-l", SHARE / "man/man1/fathom-capture.1"], capture_output=True, text=True,
                               env=os.environ | {"MANWIDTH": "200", "LC_ALL": "C.UTF-8"}).stdout
        for words in ("fathom capture -o DIR [options] scene", "--mode TEXT", "One of geometric, photometric", "-o, --output DIR", "Required."):
            self.assertIn(words, shown)

    # What is typed, what must be offered, what must not.
    CASES = [
        (["cap"], {"capture"}, {"campaign"}),
        (["ver"], {"verify"}, {"capture"}),
        (["verify", "fr"], {"fresnel"}, {"capture"}),
        (["verify", "slab", "--thick"], {"--thickness-mm"}, {"--from"}),
        (["list", "m"], {"media"}, {"--mode", "capture"}),
        (["capture", "--mo"], {"--mode", "--model"}, {"--fill-mm"}),
        (["capture", "--mode", "p"], {"photometric"}, {"capture"}),
        (["detect", "--method", "pa"], {"paper"}, {"robust"}),
    ]

    def offers(self, offered_for):
        for typed, expected, others in self.CASES:
            offered = offered_for(typed)
            self.assertTrue(expected <= offered, f"{typed}: {offered}")
            self.assertFalse(others & offered, f"{typed}: {offered}")

    def test_bash_offers_what_can_be_typed(self):
        script = SHARE / "bash-completion/completions/fathom"
        self.assertEqual(run("bash", "-n", script).stderr, "")
        self.offers(lambda typed: set(run("bash", "-c", BASH, "bash", script, *typed).stdout.split()))

    def test_bash_offers_values_behind_the_sign(self):
        script = SHARE / "bash-completion/completions/fathom"
        for typed in (["capture", "--mode", "=", "geo"], ["capture", "--mode", "="]):
            self.assertIn("geometric", run("bash", "-c", BASH, "bash", script, *typed).stdout.split())

    @having("fish")
    def test_fish_offers_what_can_be_typed(self):
        script = SHARE / "fish/vendor_completions.d/fathom.fish"
        self.assertEqual(run("fish", "--no-config", "--no-execute", script).stderr, "")

        def offered(typed):
            found = run("fish", "--no-config", "-c", f"source {script}; complete -C 'fathom {' '.join(typed)}'")
            self.assertEqual(found.stderr, "")
            return {line.split("\t")[0] for line in found.stdout.splitlines()}

        self.offers(offered)

    @having("zsh")
    def test_zsh_offers_what_can_be_typed(self):
        script = SHARE / "zsh/vendor-completions/_fathom"
        self.assertEqual(run("zsh", "-n", script).stderr, "")
        for typed, expected in (("cap", "capture"), ("verify fr", "verify fresnel"), ("capture --mode p", "capture --mode photometric"),
                                ("list med", "list media")):
            found = run("zsh", "-f", "-c", ZSH, "zsh", script, f"fathom {typed}")
            self.assertIn(f"fathom {expected}", re.sub(r"\x1b\[[0-9;?]*[a-zA-Z]|[\x00-\x08]", "", found.stdout), f"{typed}: {found.stderr}")


if __name__ == "__main__":
    unittest.main()
