"""``python -m examples.emps``: learn the friction of a positioning axis and compare with what others have published."""

from examples.emps.study import run
from examples.measured.present import command

if __name__ == "__main__":
    command("emps", "EMPS: a measured positioning axis with friction.", run)
