#!/usr/bin/env python3
"""Writes MoveNet's graph of TensorFlow.js as a file of TensorFlow Lite, weights in 16 bits as they are.

    convert_movenet.py MODEL.json MODEL.bin OUT.tflite

Only the network itself: the picture's scaling before it and the choice of places after it are limbcast's
(movenet.cpp). Needs Debian's python3-flatbuffers and python3-numpy.
"""
import base64
import json
import sys

import numpy as np

import tflite_writer
from tflite_writer import ADD, CONVOLUTION, DEPTHWISE, RELU, RELU6, RESIZE

OUTPUTS = {  # node of the graph: name of the tensor
    "StatefulPartitionedCall/center_0/conv2d_4/BiasAdd": "center",
    "StatefulPartitionedCall/kpt_heatmap_0/conv2d_5/BiasAdd": "heatmap",
    "StatefulPartitionedCall/kpt_regress_0/conv2d_6/BiasAdd": "regression",
    "StatefulPartitionedCall/kpt_offset_0/conv2d_7/BiasAdd": "offset",
}
FIRST = "StatefulPartitionedCall/sub_1"  # the picture, scaled to -1 to 1
SIDE_PX = 256
ACTIVATIONS = {b"Relu": RELU, b"Relu6": RELU6}


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


class MoveNet(tflite_writer.Graph):
    """The nodes of TensorFlow.js that lead to the outputs."""

    def __init__(self, nodes, weights):
        super().__init__("image", (1, SIDE_PX, SIDE_PX, 3))  # scaled to -1 to 1
        self.nodes = {node["name"]: node for node in nodes}
        self.weights = weights
        self.numbers[FIRST] = 0

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


def main(model_path, data_path, out_path):
    with open(model_path, encoding="utf-8") as file:
        model = json.load(file)
    with open(data_path, "rb") as file:
        weights = read_weights(model, file.read())
    graph = MoveNet(model["modelTopology"]["node"], weights)
    tflite_writer.write(graph, [graph.add(name) for name in OUTPUTS], "MoveNet SinglePose Thunder", out_path)


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
