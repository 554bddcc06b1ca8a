#!/usr/bin/env python3
"""Writes MoveNet's graph of TensorFlow.js as a file of TensorFlow Lite, weights in 16 bits as they are.

    convert_movenet.py MODEL.json MODEL.bin OUT.tflite

Only the network itself: the picture's scaling before it and the choice of places after it are limbcast's
(movenet.cpp). Needs Debian's python3-flatbuffers and python3-numpy.
"""
import base64
import json
import sys

import flatbuffers
import numpy as np

OUTPUTS = {  # node of the graph: name of the tensor
    "StatefulPartitionedCall/center_0/conv2d_4/BiasAdd": "center",
    "StatefulPartitionedCall/kpt_heatmap_0/conv2d_5/BiasAdd": "heatmap",
    "StatefulPartitionedCall/kpt_regress_0/conv2d_6/BiasAdd": "regression",
    "StatefulPartitionedCall/kpt_offset_0/conv2d_7/BiasAdd": "offset",
}
FIRST = "StatefulPartitionedCall/sub_1"  # the picture, scaled to -1 to 1
SIDE_PX = 256
# Values of TensorFlow Lite's schema.fbs, version 3.
FLOAT32, FLOAT16 = 0, 1
ADD, CONVOLUTION, DEPTHWISE, DEQUANTIZE, RESIZE = 0, 3, 4, 6, 23
OPTIONS_OF = {ADD: 11, CONVOLUTION: 1, DEPTHWISE: 2, DEQUANTIZE: 38, RESIZE: 15}
ACTIVATIONS = {b"Relu": 1, b"Relu6": 3}


def read_weights(model, data):
    weights, at = {}, 0
    for entry in model["weightsManifest"][0]["weights"]:
        kind = np.dtype(entry.get("quantization", {}).get("dtype", entry["dtype"]))
        count = int(np.prod(entry["shape"]))
        weights[entry["name"]] = np.frombuffer(data, kind, count, at).reshape(entry["shape"])
        at += count * kind.itemsize
    return weights


def text(attribute):
    return base64.b64decode(attribute["s"])


class Graph:
    """Tensors and steps, in the order in which they are computed."""

    def __init__(self, nodes, weights):
        self.nodes = {node["name"]: node for node in nodes}
        self.weights = weights
        self.tensors = [("image", (1, SIDE_PX, SIDE_PX, 3), None)]  # name, shape, weights of 16 bits
        self.steps = []  # kind, inputs, output, options
        self.numbers = {FIRST: 0}

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

    def add(self, name):
        """The number of the tensor that a node computes."""
        if name not in self.numbers:
            node = self.nodes[name]
            self.numbers[name] = {
                "_FusedConv2D": self.add_convolution,
                "FusedDepthwiseConv2dNative": self.add_depthwise,
                "DepthwiseConv2dNative": self.add_depthwise,
                "AddV2": self.add_sum,
                "ResizeBilinear": self.add_resize,
            }[node["op"]](node)
        return self.numbers[name]

    def window(self, node, columns_and_rows):
        """Output's rows and columns, and the options of a step that slides a window."""
        attributes = node["attr"]
        assert all(int(i) == 1 for i in attributes["dilations"]["list"]["i"])
        stride = int(attributes["strides"]["list"]["i"][1])
        same = text(attributes["padding"]) == b"SAME"
        activation = 0
        for fused in attributes.get("fused_ops", {}).get("list", {}).get("s", []):
            activation = ACTIVATIONS.get(base64.b64decode(fused), activation)
        size = self.shape(self.add(node["input"][0]))[1:3]
        filter_size = (1, 1) if same else columns_and_rows
        out = [-(-(size[i] - filter_size[i] + 1) // stride) for i in range(2)]
        return out, {"same": same, "stride": stride, "activation": activation}

    def add_convolution(self, node):
        source = self.add(node["input"][0])
        weights = self.weights[node["input"][1]]  # rows, columns, inputs, outputs
        out, options = self.window(node, weights.shape[:2])
        inputs = [source, self.constant(node["input"][1], weights.transpose(3, 0, 1, 2)),
                  self.constant(node["input"][2], self.weights[node["input"][2]].reshape(-1))]
        output = self.tensor(OUTPUTS.get(node["name"], node["name"]), (1, *out, weights.shape[3]))
        self.steps.append((CONVOLUTION, inputs, output, options))
        return output

    def add_depthwise(self, node):
        source = self.add(node["input"][0])
        weights = self.weights[node["input"][1]]  # rows, columns, inputs, 1
        out, options = self.window(node, weights.shape[:2])
        channels = weights.shape[2]
        assert weights.shape[3] == 1
        bias = self.weights[node["input"][2]] if len(node["input"]) > 2 else np.zeros(channels)
        inputs = [source,
                  self.constant(node["input"][1], weights.reshape(1, *weights.shape[:2], channels)),
                  self.constant(node["name"] + "/bias", bias.reshape(-1))]
        output = self.tensor(node["name"], (1, *out, channels))
        self.steps.append((DEPTHWISE, inputs, output, options))
        return output

    def add_sum(self, node):
        inputs = [self.add(name) for name in node["input"]]
        assert self.shape(inputs[0]) == self.shape(inputs[1])
        output = self.tensor(node["name"], self.shape(inputs[0]))
        self.steps.append((ADD, inputs, output, {"activation": 0}))
        return output

    def add_resize(self, node):
        assert node["attr"]["half_pixel_centers"]["b"] and not node["attr"]["align_corners"]["b"]
        source = self.add(node["input"][0])
        _, rows, columns, channels = self.shape(source)
        output = self.tensor(node["name"], (1, 2 * rows, 2 * columns, channels))
        self.steps.append((RESIZE, [source], output, {}))
        return output


def write(graph, outputs, path):
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
             builder.CreateString("MoveNet SinglePose Thunder"), references(buffers)]
    model = table({0: ("Uint32", 3), **{i + 1: reference(offset) for i, offset in enumerate(lists)}}, 5)
    builder.Finish(model, b"TFL3")
    with open(path, "wb") as file:
        file.write(builder.Output())


def main(model_path, data_path, out_path):
    with open(model_path, encoding="utf-8") as file:
        model = json.load(file)
    with open(data_path, "rb") as file:
        weights = read_weights(model, file.read())
    graph = Graph(model["modelTopology"]["node"], weights)
    write(graph, [graph.add(name) for name in OUTPUTS], out_path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
