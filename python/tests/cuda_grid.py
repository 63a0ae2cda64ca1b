"""A card of one processor in place of NVIDIA's driver and compiler: kernels are compiled as C++ and run thread after thread.

The memory of the card is that of the processor, so that tensors and arrays of it are on both.
"""

import ctypes
import pathlib
import re
import subprocess
import tempfile

GRID = pathlib.Path(__file__).parents[2] / "tests" / "batches" / "cuda_grid.h"


class Compiler:
    """The functions of NVRTC that geograd calls."""

    def __init__(self):
        self.texts = []

    def nvrtcVersion(self):
        return 0, 0, 0

    def nvrtcCreateProgram(self, source, name, count, headers, names):
        self.texts.append(source.decode())
        return 0, {"source": source.decode()}

    def nvrtcCompileProgram(self, program, count, options):
        kernel = re.search(r'extern "C" __global__ void (\w+)\((.*?)\) \{', program["source"], re.S)
        types = [part.rsplit(" ", 1) for part in kernel[2].split(", ")]
        types = [kind + "*" * (len(name) - len(name.lstrip("*"))) for kind, name in types]
        values = ", ".join(f"*({kind} *)values[{k}]" for k, kind in enumerate(types))
        run = (
            '\nextern "C" void run(unsigned blocks, unsigned threads, void **values) {\n    blockDim.x = threads;\n'
            "    for (blockIdx.x = 0; blockIdx.x < blocks; blockIdx.x += 1) {\n"
            f"        for (threadIdx.x = 0; threadIdx.x < threads; threadIdx.x += 1) {{\n            {kernel[1]}({values});\n"
            "        }\n    }\n}\n"
        )
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / "kernel.cpp").write_text(f'#define GRID\n#include "{GRID}"\n{program["source"]}{run}')
            command = ["c++", "-std=c++11", "-Wall", "-Wextra", "-Werror", "-O0", "-ffp-contract=off", "-shared", "-fPIC"]
            done = subprocess.run([*command, "-o", path / "kernel.so", path / "kernel.cpp"], capture_output=True)
            program["log"] = done.stderr
            program["image"] = b"" if done.returncode else (path / "kernel.so").read_bytes()
        return (done.returncode,)

    def nvrtcGetProgramLogSize(self, program):
        return 0, len(program["log"]) + 1

    def nvrtcGetProgramLog(self, program, log):
        ctypes.memmove(ctypes.c_char_p(log), program["log"], len(program["log"]))
        return (0,)

    def nvrtcGetCUBINSize(self, program):
        return 0, len(program["image"])

    def nvrtcGetCUBIN(self, program, image):
        ctypes.memmove(ctypes.c_char_p(image), program["image"], len(image))
        return (0,)

    def nvrtcDestroyProgram(self, program):
        return (0,)


class Driver:
    """The functions of the driver that geograd calls; it counts what is launched, allocated and freed."""

    class CUpointer_attribute:
        CU_POINTER_ATTRIBUTE_DEVICE_ORDINAL = "device"

    class CUdevice_attribute:
        CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MAJOR = "major"
        CU_DEVICE_ATTRIBUTE_COMPUTE_CAPABILITY_MINOR = "minor"

    def __init__(self):
        self.launches, self.waited, self.contexts, self.memory, self.largest = 0, [], [], {}, 0

    def cuModuleLoadData(self, image):
        with tempfile.NamedTemporaryFile(suffix=".so") as file:
            file.write(image)
            file.flush()
            return 0, ctypes.CDLL(file.name)

    def cuModuleGetFunction(self, module, name):
        return 0, module.run

    def cuLaunchKernel(self, function, *settings):
        blocks, _, _, threads, _, _, _, stream, (values, types), _ = settings
        assert len(values) == len(types)
        self.launches += 1
        cells = [kind(value) for kind, value in zip(types, values)]
        addresses = (ctypes.c_void_p * len(cells))(*[ctypes.addressof(cell) for cell in cells])
        function(ctypes.c_uint(blocks), ctypes.c_uint(threads), addresses)
        return (0,)

    def cuInit(self, flags):
        return (0,)

    def cuPointerGetAttribute(self, attribute, pointer):
        return 0, 0

    def cuDeviceGet(self, ordinal):
        return 0, ordinal

    def cuDeviceGetAttribute(self, attribute, device):
        return 0, {"major": 9, "minor": 0}[attribute]

    def cuDevicePrimaryCtxRetain(self, device):
        return 0, f"context of {device}"

    def cuCtxPushCurrent(self, context):
        self.contexts.append(context)
        return (0,)

    def cuCtxPopCurrent(self):
        return 0, self.contexts.pop()

    def cuStreamSynchronize(self, stream):
        self.waited.append(int(stream))
        return (0,)

    def cuMemAlloc(self, size):
        assert self.contexts
        block = (ctypes.c_char * size)()
        self.memory[ctypes.addressof(block)] = block
        self.largest = max(self.largest, size)
        return 0, ctypes.addressof(block)

    def cuMemFree(self, address):
        del self.memory[int(address)]
        return (0,)

    def cuMemcpyDtoH(self, to, address, size):
        ctypes.memmove(to, int(address), size)
        return (0,)

    def cuMemcpyHtoD(self, address, source, size):
        ctypes.memmove(int(address), source, size)
        return (0,)
