"""``python -m examples.silverbox``: learn the Silverbox and compare with what others have published."""

from examples.measured.present import command
from examples.silverbox.study import run

if __name__ == "__main__":
    command("silverbox", "The Silverbox: a measured suspension with a progressive spring.", run)
