"""``python -m examples.cascaded_tanks``: learn the Cascaded Tanks and compare with what others have published."""

from examples.cascaded_tanks.study import run
from examples.measured.present import command

if __name__ == "__main__":
    command("cascaded_tanks", "The Cascaded Tanks: a measured pump and two tanks.", run)
