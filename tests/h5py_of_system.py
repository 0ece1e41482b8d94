"""h5py, of the Python that runs a script or else of the system's: `from h5py_of_system import h5py`."""
import os, sys

try:
    import h5py
except ImportError:
    # a Python of one's own may lack what the system's has
    if os.environ.get("VIBROCONTACT_SYSTEM_PYTHON"):
        raise
    os.environ["VIBROCONTACT_SYSTEM_PYTHON"] = "yes"
    os.execv("/usr/bin/python3", ["/usr/bin/python3", "-B", *sys.argv])
