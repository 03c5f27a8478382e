"""``python -m foamprb``."""

import sys

from foamprb.cli import main

sys.exit(main())
