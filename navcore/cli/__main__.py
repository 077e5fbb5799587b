"""`python -m navcore.cli`, the same as `rowpilot`: for programs that know their Python and not their PATH."""

from navcore.cli import main

main()
