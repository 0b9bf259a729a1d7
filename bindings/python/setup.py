# SPDX-License-Identifier: Apache-2.0
"""One wheel for every Python 3 of Linux: the library is called through ctypes."""
from setuptools import setup
from setuptools.dist import Distribution

try:
    from wheel.bdist_wheel import bdist_wheel
except ImportError:
    bdist_wheel = None


class WithLibrary(Distribution):
    def has_ext_modules(self):
        return True


commands = {}
if bdist_wheel is not None:

    class AnyPython(bdist_wheel):
        def get_tag(self):
            return "py3", "none", super().get_tag()[2]

    commands["bdist_wheel"] = AnyPython

setup(distclass=WithLibrary, cmdclass=commands)
