"""Command: the library from a terminal.

In: words typed in a shell. Out: text, JSON or files, and an exit code.
It uses the public names, as a user's program does; no room imports it. They load when a command runs, so that
`acausal --help` is there at once.
"""

from acausal.command.exit_codes import EXIT_CODES as EXIT_CODES
from acausal.command.program import main as main
