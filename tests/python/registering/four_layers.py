"""For `pytest -p`: from its first test on, the registry holds the example of docs/plugins.md."""

import guides

guides.register_four_layers()
