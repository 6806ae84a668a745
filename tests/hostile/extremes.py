"""Numbers, words and paths that no honest file holds."""
import os

NUMBERS = [
    "0", "-0", "-0.0", "1", "-1", "2", "0.5", "1e308", "-1e308", "1.8e308", "1e400", "-1e400", "1e38", "3.5e38", "1e22", "-1e22",
"1e9",
    "-1e9", "1e6", "-1e6", "1e5", "1e4", "1000", "-1000", "360", "90", "-90", "1e-3", "1e-9", "1e-30", "1e-300", "5e-324",
"-1e-300", "255", "256",
    "32767", "65535", "65536", "2147483647", "2147483648", "-2147483648", "4294967295", "4294967296",
    "9223372036854775807", "9223372036854775808", "18446744073709551615", "18446744073709551616", "1" + "0" * 60, "0." + "3" * 400,
]
NO_NUMBERS = ["NaN", "NAN", "Infinity", "-INF", "0x10", "1,5", "1e", "+-1", "--1", "1.2.3", "", " ", "1 mm", "٣", "01", ".5", "5."]

# Each would make a file named `pwned`, were it run; the rest breaks what is put together by pasting.
CODE = [
    "x'; system('touch pwned'); set label 'y", 'x"; system("touch pwned"); set label "y', "x`touch pwned`", "$(touch pwned)",
    "x\n!touch pwned\n", "x'\nsystem('touch pwned')\n#", "'.system('touch pwned').'", '".system("touch pwned")."',
    "<script>document.title='pwned'</script>", "'><img src=x onerror=pwned>", "@PWNED", "\\", "x\\'; !touch pwned\n",
    "touch pwned|", "|touch pwned", "< touch pwned", "-e system('touch pwned')",
]
WORDS = CODE + [
    "", " ", "farmer's milk", 'the "best" milk', "a,b", "a;b", "a\tb", "a\nb", "a\r\nb", "\u0000", "a\u0000b", "\u001b[31mred", "é",
"水", "🥛",
    "\u202eright to left", "\u2028", "\ufeffbom", "%s%n%d%x", "{}", "{0}", "{/Symbol a}", "a_b^c", "&amp;<b>", "]]>", "null",
"true", "none",
    "empty", "NaN", "-1", "-o", "--help", "=1+1", "~", "$HOME", "x" * 300, "x" * 5000, "'" * 300, "é" * 300, "a/b", "../pwned",
"../../pwned",
    "/tmp/pwned", "..", ".", "/", "//", "con", "a" * 255, "a" * 256, "a" * 4096,
]
LONG_WORDS = ["y" * 100_000, "z/" * 50_000, "\\" * 100_000, "\n" * 10_000]


def paths(folder):
    """Paths to things that are no files of ours; `folder` holds what special_files() made."""
    return ["/dev/zero", "/dev/full", "/dev/stdin", "/dev/null", "/etc/hostname", "/proc/self/mem", "/proc/self/environ", "..", ".",
            "/", "",
            "../outside/secret.json", "../outside/secret.png", str(folder / "fifo"), "fifo", "loop", "folder", "zero", "dangling",
            "file:///etc/hostname", "http://localhost/x", "a" * 5000, "x\u0000y", "~/x", "no_such_file", "../" * 40 +
            "etc/hostname"]


def special_files(folder):
    """What a path may lead to instead of a file."""
    os.mkfifo(folder / "fifo")
    os.symlink("loop", folder / "loop")
    os.symlink("/dev/zero", folder / "zero")
    os.symlink("no_such_file", folder / "dangling")
    (folder / "folder").mkdir()


def number(rng, was="1"):
    """A number as text: an extreme one, or one that differs from `was` by a factor."""
    if rng.random() < 0.5:
        return rng.choice(NUMBERS)
    try:
        value = float(was) * rng.choice([-1, 0, 0.1, 0.5, 0.9, 1.1, 2, 3, 10, 100, 1000, 1e-3, 1e-6, 1e6])
    except ValueError:
        return rng.choice(NUMBERS)
    return repr(int(value)) if value == value and abs(value) < 1e15 and value == int(value) and rng.random() < 0.8 else repr(value)


def word(rng):
    return rng.choice(LONG_WORDS) if rng.random() < 0.03 else rng.choice(CODE) if rng.random() < 0.25 else rng.choice(WORDS)
