"""`python -m acausal`: the command line."""

import sys

from acausal.command import main

sys.exit(main())
