#!/usr/bin/python3
"""Converts BlazePose's landmark network from TensorFlow Lite to ONNX, which OpenCV 4.6 reads.

Needs Debian's python3-onnx and python3-flatbuffers. The same input gives the same bytes.
"""

import sys

import onnx
from onnx import TensorProto, helper, numpy_helper

import tflite

# The outputs that are kept, by their names in the .tflite file. Identity_2 (mask of the person) and Identity_3 (heat maps)
# are left out, with what only they need.
OUTPUTS = {"Identity": "landmarks", "Identity_1": "score", "Identity_4": "world_landmarks"}

# Version of ONNX's operators: the last in which Pad and Clip have their limits as attributes, so that each is one step.
OPSET = 10


def needed_operators(model):
    """The steps that lead to OUTPUTS, in the order in which they are run."""
    needed = {model.outputs[name] for name in OUTPUTS}
    operators = []
    for step in reversed(model.operators):
        if step.output in needed and step.kind != tflite.DEQUANTIZE:
            operators.append(step)
            needed.update(step.inputs)
    return operators[::-1]


def same_padding(size, kernel, stride):
    """What TensorFlow's padding "SAME" adds before and after: the odd pixel comes after."""
    total = max((-(-size // stride) - 1) * stride + kernel - size, 0)
    return total // 2, total - total // 2


class Converter:
    """Tensors of TensorFlow Lite are laid out as rows, columns, channels; those of ONNX channels first."""

    def __init__(self, model):
        self.model = model
        self.names = {model.outputs[name]: kept for name, kept in OUTPUTS.items()}
        self.names[model.input] = "image"
        self.nodes, self.weights = [], []

    def convert(self):
        steps = {tflite.PAD: self._pad, tflite.CONV_2D: self._convolution, tflite.DEPTHWISE_CONV_2D: self._convolution,
                 tflite.MAX_POOL_2D: self._max_pool, tflite.ADD: self._add, tflite.LOGISTIC: self._sigmoid,
                 tflite.RESHAPE: self._flatten}
        for step in needed_operators(self.model):
            steps[step.kind](step)
        _, height, width, channels = self.model.shapes[self.model.input]
        inputs = [helper.make_tensor_value_info("image", TensorProto.FLOAT, [1, channels, height, width])]
        outputs = [helper.make_tensor_value_info(kept, TensorProto.FLOAT, self.model.shapes[self.model.outputs[name]])
                   for name, kept in OUTPUTS.items()]
        graph = helper.make_graph(self.nodes, "blazepose", inputs, outputs, self.weights)
        model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", OPSET)])
        onnx.checker.check_model(model)
        return model

    def _name(self, tensor):
        return self.names.get(tensor, f"t{tensor}")

    def _weight(self, name, values):
        self.weights.append(numpy_helper.from_array(values, name))
        return name

    def _node(self, kind, step, activation=tflite.NO_ACTIVATION, weights=(), **attributes):
        inputs = [self._name(i) for i in step.inputs if i not in self.model.constants] + list(weights)
        output = self._name(step.output)
        if activation == tflite.NO_ACTIVATION:
            self.nodes.append(helper.make_node(kind, inputs, [output], **attributes))
            return
        before = output + "_before"
        self.nodes.append(helper.make_node(kind, inputs, [before], **attributes))
        if activation == tflite.RELU:
            self.nodes.append(helper.make_node("Relu", [before], [output]))
        elif activation == tflite.RELU6:
            self.nodes.append(helper.make_node("Clip", [before], [output], min=0.0, max=6.0))
        else:
            raise SystemExit(f"activation {activation} is not known")

    def _window(self, step, kernel):
        """Attributes of what looks through a window: its size, steps and padding."""
        strides = [step.option(2), step.option(1)]
        pads = [(0, 0), (0, 0)]
        if step.choice(0) == tflite.SAME:
            size = self.model.shapes[step.inputs[0]][1:3]
            pads = [same_padding(*sizes) for sizes in zip(size, kernel, strides)]
        return {"kernel_shape": kernel, "strides": strides, "pads": [before for before, _ in pads] + [after for _, after in pads]}

    def _convolution(self, step):
        depthwise = step.kind == tflite.DEPTHWISE_CONV_2D
        weights, bias = (self.model.constants[i] for i in step.inputs[1:])
        weights = weights.transpose((3, 0, 1, 2) if depthwise else (0, 3, 1, 2)).copy()
        names = [self._weight(f"w{step.output}", weights), self._weight(f"b{step.output}", bias)]
        group = self.model.shapes[step.inputs[0]][3] if depthwise else 1
        self._node("Conv", step, step.choice(4 if depthwise else 3), names, group=group,
                   **self._window(step, list(weights.shape[2:])))

    def _max_pool(self, step):
        self._node("MaxPool", step, **self._window(step, [step.option(4), step.option(3)]))

    def _pad(self, step):
        images, rows, columns, channels = self.model.constants[step.inputs[1]].tolist()
        if images != [0, 0] or channels != [0, 0]:
            raise SystemExit("only rows and columns are padded here")
        self._node("Pad", step, mode="constant", pads=[0, 0, rows[0], columns[0], 0, 0, rows[1], columns[1]])

    def _add(self, step):
        self._node("Add", step, step.choice(0))

    def _sigmoid(self, step):
        self._node("Sigmoid", step)

    def _flatten(self, step):
        if self.model.shapes[step.inputs[0]][1:3] != [1, 1]:
            raise SystemExit("only single pixels are flattened: others would change their order")
        self._node("Flatten", step, axis=1)


def main():
    if len(sys.argv) != 3:
        raise SystemExit("usage: blazepose_to_onnx.py IN.tflite OUT.onnx")
    with open(sys.argv[1], "rb") as file:
        model = tflite.Model(bytearray(file.read()))
    onnx.save(Converter(model).convert(), sys.argv[2])


main()
