"""The frames of ``benchmark.calls`` as two programmes: main.cpp, and this package as a module."""
