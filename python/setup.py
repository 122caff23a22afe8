"""The wheel contains a module that CMake has built (the target `wheel`); packaging/wheel.py computes the tag of its platform."""
import os

from setuptools import Distribution, setup


class Built(Distribution):
    def has_ext_modules(self):
        return True


setup(distclass=Built, options={"bdist_wheel": {"plat_name": os.environ["RIPSTOP_PLATFORM"]}})
