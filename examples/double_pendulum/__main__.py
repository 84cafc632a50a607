"""``python -m examples.double_pendulum``: learn the friction of a double pendulum's joints from measured swings."""

from examples.double_pendulum.study import run
from examples.measured.present import command

if __name__ == "__main__":
    command("double_pendulum", "Measured swings of a double pendulum.", run)
