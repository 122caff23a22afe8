"""The wheel holds a module that CMake has built (the target `wheel`): only its name has to say for which machine."""
from setuptools import Distribution, setup


class Built(Distribution):
    def has_ext_modules(self):
        return True


setup(distclass=Built)
