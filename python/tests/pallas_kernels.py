"""Kernels of Pallas outside of JAX: their texts, and machine code by Triton, which needs no card."""


def texts_of(lowered):
    """The kernels of a lowered function, as texts of Triton's dialect."""
    from jax._src.interpreters import mlir
    from jaxlib.mlir import ir
    from jaxlib.triton import dialect

    found, texts = [], []

    def walk(operation):
        for region in operation.regions:
            for block in region.blocks:
                for one in block.operations:
                    if one.operation.name == "stablehlo.custom_call":
                        settings = ir.DictAttr(one.operation.attributes["mhlo.backend_config"])
                        found.append(ir.StringAttr(settings["ir"]).value_bytes)
                    walk(one.operation)

    walk(lowered.compiler_ir().operation)
    for code in found:
        with mlir.make_ir_context() as context:
            dialect.register_dialect(context)
            texts.append(ir.Module.parse(code).operation.get_asm(enable_debug_info=False))
    return texts


def compiled(text, folder):
    """What Triton makes of a text for cards of compute capability 9.0."""
    import triton
    from triton.backends.compiler import GPUTarget

    path = folder / "kernel.ttir"
    path.write_text(text)
    return triton.compile(str(path), target=GPUTarget("cuda", 90, 32), options={"num_warps": 4, "num_stages": 1})
