"""Writes networks as files of TensorFlow Lite, weights in 16 bits. Needs Debian's python3-flatbuffers and
python3-numpy.
"""
import flatbuffers
import numpy as np

# Values of TensorFlow Lite's schema.fbs, version 3.
FLOAT32, FLOAT16 = 0, 1
ADD, CONVOLUTION, DEPTHWISE, DEQUANTIZE, RESIZE = 0, 3, 4, 6, 23
OPTIONS_OF = {ADD: 11, CONVOLUTION: 1, DEPTHWISE: 2, DEQUANTIZE: 38, RESIZE: 15}
RELU, RELU6 = 1, 3


class Graph:
    """Tensors and steps, in the order in which they are computed."""

    def __init__(self, input_name, input_shape):
        self.tensors = [(input_name, input_shape, None)]  # name, shape, weights of 16 bits
        self.steps = []  # kind, inputs, output, options
        self.numbers = {}  # of tensors, by their names

    def tensor(self, name, shape, values=None):
        self.tensors.append((name, tuple(int(size) for size in shape), values))
        return len(self.tensors) - 1

    def constant(self, name, values):
        """Weights stand in the file in 16 bits and are widened by a step of their own."""
        if name in self.numbers:
            return self.numbers[name]
        halves = self.tensor(name + "/half", values.shape, np.ascontiguousarray(values, np.float16))
        self.numbers[name] = self.tensor(name, values.shape)
        self.steps.append((DEQUANTIZE, [halves], self.numbers[name], {}))
        return self.numbers[name]

    def shape(self, tensor):
        return self.tensors[tensor][1]


def write(graph, outputs, description, path):
    builder = flatbuffers.Builder(16 << 20)

    def numbers(values):
        return builder.CreateNumpyVector(np.asarray(values, np.int32))

    def references(offsets):
        builder.StartVector(4, len(offsets), 4)
        for offset in reversed(offsets):
            builder.PrependUOffsetTRelative(offset)
        return builder.EndVector()

    def table(fields, size):
        """Fields: number in schema.fbs: (kind of slot, value)."""
        builder.StartObject(size)
        for slot, (kind, value) in fields.items():
            default = 0 if kind != "Bool" else False
            getattr(builder, f"Prepend{kind}Slot")(slot, value, default)
        return builder.EndObject()

    def reference(offset):
        return ("UOffsetTRelative", offset)

    def options_table(kind, options):
        padding = {0: ("Int8", 0 if options.get("same") else 1)}
        stride = {1: ("Int32", options.get("stride", 0)), 2: ("Int32", options.get("stride", 0))}
        activation = options.get("activation", 0)
        if kind == CONVOLUTION:
            return table({**padding, **stride, 3: ("Int8", activation)}, 6)
        if kind == DEPTHWISE:
            return table({**padding, **stride, 3: ("Int32", 1), 4: ("Int8", activation)}, 7)
        if kind == RESIZE:
            return table({3: ("Bool", True)}, 4)  # half_pixel_centers
        return table({0: ("Int8", activation)} if kind == ADD else {}, 2)

    buffers, tensors = [table({}, 1)], []  # the first buffer: no numbers
    for name, shape, values in graph.tensors:
        buffer = 0
        if values is not None:
            data = builder.CreateNumpyVector(values.reshape(-1).view(np.uint8))
            buffer = len(buffers)
            buffers.append(table({0: reference(data)}, 1))
        shape_at, name_at = numbers(shape), builder.CreateString(name)
        kind = FLOAT32 if values is None else FLOAT16
        tensors.append(table({0: reference(shape_at), 1: ("Int8", kind), 2: ("Uint32", buffer),
                              3: reference(name_at)}, 4))
    kinds = sorted({step[0] for step in graph.steps})
    codes = [table({0: ("Int8", kind), 2: ("Int32", 1), 3: ("Int32", kind)}, 4) for kind in kinds]
    steps = []
    for kind, inputs, output, options in graph.steps:
        inputs_at, outputs_at = numbers(inputs), numbers([output])
        options_at = options_table(kind, options)
        steps.append(table({0: ("Uint32", kinds.index(kind)), 1: reference(inputs_at),
                            2: reference(outputs_at), 3: ("Uint8", OPTIONS_OF[kind]),
                            4: reference(options_at)}, 5))
    fields = [references(tensors), numbers([0]), numbers(outputs), references(steps)]
    graph_at = table({i: reference(offset) for i, offset in enumerate(fields)}, 5)
    lists = [references(codes), references([graph_at]),
             builder.CreateString(description), references(buffers)]
    model = table({0: ("Uint32", 3), **{i + 1: reference(offset) for i, offset in enumerate(lists)}}, 5)
    builder.Finish(model, b"TFL3")
    with open(path, "wb") as file:
        file.write(builder.Output())
