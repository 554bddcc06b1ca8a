"""Reads TensorFlow Lite files without TensorFlow, by the field numbers of its schema.fbs (version 3)."""

import flatbuffers
import numpy as np
from flatbuffers import number_types as types
from flatbuffers.table import Table

# Values of schema.fbs: TensorType, ActivationFunctionType, Padding and BuiltinOperator.
TENSOR_TYPES = {0: np.float32, 1: np.float16, 2: np.int32}
NO_ACTIVATION, RELU, RELU6 = 0, 1, 3
SAME = 0
ADD, CONV_2D, DEPTHWISE_CONV_2D, DEQUANTIZE = 0, 3, 4, 6
LOGISTIC, MAX_POOL_2D, RESHAPE, PAD = 14, 17, 22, 34


class Record:
    """A table of the file, whose fields are asked by their numbers."""

    def __init__(self, data, position):
        self.table = Table(data, position)

    def _offset(self, field):
        return self.table.Offset(4 + 2 * field)

    def _record(self, position):
        return Record(self.table.Bytes, self.table.Indirect(position))

    def number(self, field, kind, default=0):
        offset = self._offset(field)
        return self.table.Get(kind, offset + self.table.Pos) if offset else default

    def union(self, field):
        return self._record(self._offset(field) + self.table.Pos)

    def text(self, field):
        return self.table.String(self._offset(field) + self.table.Pos).decode()

    def _vector(self, field):
        offset = self._offset(field)
        return (self.table.Vector(offset), self.table.VectorLen(offset)) if offset else (0, 0)

    def integers(self, field):
        start, count = self._vector(field)
        return [self.table.Get(types.Int32Flags, start + 4 * k) for k in range(count)]

    def records(self, field):
        start, count = self._vector(field)
        return [self._record(start + 4 * k) for k in range(count)]

    def data(self, field):
        start, count = self._vector(field)
        return bytes(self.table.Bytes[start:start + count])


class Operator:
    """A step of the network: its kind, the numbers of its tensors, and its options."""

    def __init__(self, record, kinds):
        self.kind = kinds[record.number(0, types.Uint32Flags)]
        self.inputs = record.integers(1)
        self.output = record.integers(2)[0]
        self._record = record

    def option(self, field, kind=types.Int32Flags):
        return self._record.union(4).number(field, kind)

    def choice(self, field):
        return self.option(field, types.Int8Flags)


class Model:
    """The first (and only) graph of a file."""

    def __init__(self, data):
        root = flatbuffers.encode.Get(types.UOffsetTFlags.packer_type, data, 0)
        model = Record(data, root)
        # Newer files write the kind into the second field, older ones into the first.
        kinds = [max(code.number(0, types.Int8Flags), code.number(3, types.Int32Flags))
                 for code in model.records(1)]
        buffers = model.records(4)
        graph = model.records(2)[0]
        tensors = graph.records(0)
        self.shapes = [tensor.integers(0) for tensor in tensors]
        self.input = graph.integers(1)[0]
        self.outputs = {tensors[i].text(3): i for i in graph.integers(2)}
        self.operators = [Operator(record, kinds) for record in graph.records(3)]
        self.constants = {}
        for i, tensor in enumerate(tensors):
            values = buffers[tensor.number(2, types.Uint32Flags)].data(0)
            if values:
                kind = TENSOR_TYPES[tensor.number(1, types.Int8Flags)]
                self.constants[i] = np.frombuffer(values, kind).reshape(self.shapes[i] or [-1])
        for step in self.operators:
            if step.kind == DEQUANTIZE:
                self.constants[step.output] = self.constants[step.inputs[0]].astype(np.float32)
