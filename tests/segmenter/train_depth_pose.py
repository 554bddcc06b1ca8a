#!/usr/bin/env python3
"""Trains limbcast's own networks of poses and writes them as files of TensorFlow Lite.

    train_depth_pose.py OUT.tflite SCANS_OUT.tflite BENT_OUT.tflite TRAINING.bin... --rings SCANS.bin...
                        --rasters SCANS.bin... --bent BENT.bin... [--check CHECK.bin...]

OUT, for cameras, is trained on TRAINING; from there BENT_OUT on BENT and 1.4 times as many pictures of TRAINING,
and SCANS_OUT on scans of rotating and of tilting scanners. Files are those of limbcast-write-depth-pictures. After
each few epochs it prints what the network sees of the files to check by. train_depth_pose.sh makes the pictures and
runs it. Needs Debian's python3-torch and python3-flatbuffers. On processors that compute with brain floats of 16 bits
layers are computed in these.
"""
import argparse
import copy
import os
import sys
import time

import numpy as np
import torch
import torch.nn.functional as F
from torch import nn

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../modules/segmenter/models"))
import tflite_writer  # noqa: E402
from tflite_writer import ADD, CONVOLUTION, RELU, RESIZE  # noqa: E402

CHANNELS_SEEN = 4  # of the picture: OWN ...
OWN, DEPTH, OTHER, OTHER_DEPTH = range(CHANNELS_SEEN)
SIDE, CELLS, JOINTS = 128, 32, 16  # of the picture [px], of the grid that the network tells, of the body
CELL = SIDE // CELLS
DEPTH_UNIT_M = 0.25  # of the depths that the network tells; depth_pose.cpp knows it
PICTURE_UNIT_M = 0.5  # of the picture's depths (DepthPictureParams)
RECORD = np.dtype([("channels", "<f2", (SIDE, SIDE, CHANNELS_SEEN)), ("joints", "<f4", (JOINTS, 5)),
                   ("px_per_m", "<f4"), ("is_person", "<f4")])
U, V, BEHIND_M, VISIBLE, TOLD = range(5)  # of a joint in a record; behind the picture's middle
PRESENCE, OFFSET_U, OFFSET_V, BEHIND, SIGHT = range(5)  # what a cell tells of each joint
PERSON = JOINTS * 5  # the last figure of a cell: its mean over all cells is the log odds that a person is there
MOST_UNITS = 2.0  # of a picture's depths (DepthPictureParams)
LIMB_ENDS = [6, 7, 8, 9, 12, 13, 14, 15]  # elbows, wrists, knees, ankles
MIRRORED = [0, 1, 2, 3] + [4 + (i ^ 1) for i in range(12)]

CYCLES = ((24, 2e-3), (8, 1e-3))  # epochs, and the highest rate, which falls to nothing in each
SCAN_CYCLES = ((12, 8e-4), (5, 5e-4))
BENT_CYCLES = ((10, 6e-4),)
USUAL_FOR_EACH_BENT = 1.4  # pictures of usual postures and of things among those of who bends or holds something
MOST_THINGS = 1200  # of a file of scans
BATCH = 32


CHANNELS, BLOCKS = (24, 48, 96, 160), (0, 1, 2, 2)  # of the four halvings


class Stage(nn.Module):
    """Half the size and, `blocks` times, what two convolutions change."""

    def __init__(self, inputs, outputs, blocks):
        super().__init__()
        self.smaller = nn.Conv2d(inputs, outputs, 3, 2)
        self.norm = nn.BatchNorm2d(outputs)
        self.blocks = nn.ModuleList(
            nn.Sequential(nn.Conv2d(outputs, outputs, 3, padding=1), nn.BatchNorm2d(outputs), nn.ReLU(),
                          nn.Conv2d(outputs, outputs, 3, padding=1), nn.BatchNorm2d(outputs))
            for _ in range(blocks))

    def forward(self, x):
        x = F.relu(self.norm(self.smaller(F.pad(x, (0, 1, 0, 1)))))  # TensorFlow's "SAME"
        for block in self.blocks:
            x = F.relu(x + block(x))
        return x


class Joined(nn.Module):
    """A stage's picture with what the coarser one tells."""

    def __init__(self, coarse, fine):
        super().__init__()
        self.narrow = nn.Conv2d(coarse, fine, 1)
        self.conv = nn.Conv2d(fine, fine, 3, padding=1)
        self.norm = nn.BatchNorm2d(fine)

    def forward(self, coarse, fine):
        twice = F.interpolate(self.narrow(coarse), scale_factor=2, mode="bilinear", align_corners=False)
        return F.relu(self.norm(self.conv(fine + twice)))


class DepthPose(nn.Module):
    """Four halvings of the picture and two steps back (a feature pyramid: Lin et al., CVPR 2017)."""

    def __init__(self):
        super().__init__()
        channels = CHANNELS
        self.stages = nn.ModuleList(map(Stage, (CHANNELS_SEEN, *channels), channels, BLOCKS))
        self.joined = nn.ModuleList([Joined(channels[3], channels[2]), Joined(channels[2], channels[1])])
        self.out = nn.Conv2d(channels[1], JOINTS * 5 + 1, 1)
        with torch.no_grad():
            self.out.bias.zero_()
            self.out.bias[:JOINTS] = -3.0  # few cells hold a joint

    def forward(self, x):
        seen = []
        for stage in self.stages:
            x = stage(x)
            seen.append(x)
        return self.out(self.joined[1](self.joined[0](seen[3], seen[2]), seen[1]))


# Training


def read_records(paths, most_things=None):
    """All people of the files, and so many things of each."""
    parts = []
    for path in paths:
        records = np.memmap(path, RECORD, "r")
        things = np.random.default_rng(1).permutation(np.flatnonzero(records["is_person"] == 0))
        kept = np.concatenate([np.flatnonzero(records["is_person"]), things[:most_things]])
        parts.append(records[np.sort(kept)])
    return np.concatenate(parts)


def tensors_of(records):
    channels = torch.from_numpy(records["channels"].astype(np.float32)).permute(0, 3, 1, 2)
    return channels, torch.from_numpy(records["joints"].copy()), torch.from_numpy(records["is_person"].copy())


def mirror_some(x, joints, random):
    some = torch.from_numpy(random.random(len(x)) < 0.5)
    mirrored = joints[:, MIRRORED].clone()
    mirrored[:, :, U] = (SIDE - 1) - mirrored[:, :, U]
    return torch.where(some[:, None, None, None], x.flip(3), x), torch.where(some[:, None, None], mirrored, joints)


def change_depths(x, change):
    """Of what was measured; what else than the person was is before or behind the middle by its depth."""
    own, other = x[:, OWN], (x[:, OTHER] != 0).float()
    x[:, DEPTH] = change(x[:, DEPTH]).clamp(-MOST_UNITS, MOST_UNITS) * own
    x[:, OTHER_DEPTH] = change(x[:, OTHER_DEPTH]).clamp(-MOST_UNITS, MOST_UNITS) * other
    x[:, OTHER] = torch.where(x[:, OTHER_DEPTH] < 0, -other, other)


def move(x, joints, random, scans):
    """Turned by 3.4 degrees, 8 % larger, moved by 4 px and 5 cm in depth (standard deviations). A quarter of the scans
    by 10 px: where nobody's head was found it is a guess."""
    count = len(x)
    draw = lambda spread, *shape: torch.from_numpy(random.normal(0, spread, (count, *shape)).astype(np.float32))
    angle, size, shift, behind_m = draw(0.06), torch.exp(draw(0.08)), draw(4.0, 2), draw(0.05)
    if scans:
        shift *= torch.from_numpy(np.where(random.random((count, 1)) < 0.25, 2.5, 1.0).astype(np.float32))
    cos, sin = torch.cos(angle), torch.sin(angle)
    middle = (SIDE - 1) / 2
    rows, columns = torch.meshgrid(torch.arange(SIDE).float(), torch.arange(SIDE).float(), indexing="ij")
    each = lambda values: values[:, None, None]
    u = (columns[None] - middle - each(shift[:, 0])) / each(size)
    v = (rows[None] - middle - each(shift[:, 1])) / each(size)
    from_u, from_v = each(cos) * u - each(sin) * v, each(sin) * u + each(cos) * v
    grid = (torch.stack([from_u, from_v], 3) + middle + 0.5) / SIDE * 2 - 1
    x = F.grid_sample(x, grid, mode="nearest", padding_mode="zeros", align_corners=False)
    change_depths(x, lambda depths: depths * each(size) + each(behind_m) / PICTURE_UNIT_M)
    du, dv = joints[:, :, U] - middle, joints[:, :, V] - middle
    joints = joints.clone()
    joints[:, :, U] = size[:, None] * (cos[:, None] * du + sin[:, None] * dv) + middle + shift[:, :1]
    joints[:, :, V] = size[:, None] * (-sin[:, None] * du + cos[:, None] * dv) + middle + shift[:, 1:]
    joints[:, :, BEHIND_M] = joints[:, :, BEHIND_M] * size[:, None] + behind_m[:, None]
    return x, joints


def add_noise(x, random):
    """Of up to 3 cm from pixel to pixel, and in a third of the pictures in waves of a hand's size, as matching by
    windows makes them."""
    spread = lambda: torch.from_numpy((0.03 * random.random((len(x), 1, 1)) ** 2).astype(np.float32))
    noise = torch.randn(len(x), SIDE, SIDE) * spread()
    wavy = torch.from_numpy((random.random((len(x), 1, 1)) < 0.33).astype(np.float32))
    waves = F.interpolate(torch.randn(len(x), 1, SIDE // 6, SIDE // 6), size=(SIDE, SIDE), mode="bicubic",
                          align_corners=False)[:, 0]
    noise += waves * wavy * spread()
    change_depths(x, lambda depths: depths + noise / PICTURE_UNIT_M)


def hide_parts(x, random):
    """Something stands before a part, or it was not measured; or the image ends above the feet, in the head or in an
    arm."""
    for picture in x:
        if random.random() < 0.35:
            width, height = random.integers(8, 40, 2)
            left, top = random.integers(0, SIDE - width), random.integers(0, SIDE - height)
            part = picture[:, top:top + height, left:left + width]
            part[:] = 0
            if random.random() < 0.5:
                part[OTHER] = -1
                part[OTHER_DEPTH] = -random.uniform(0.3, MOST_UNITS)
        if random.random() < 0.1:
            picture[:, random.integers(SIDE // 2, SIDE):] = 0
        if random.random() < 0.1:
            picture[:, :random.integers(SIDE // 8, SIDE // 4)] = 0
        if random.random() < 0.1:
            edge = random.integers(SIDE // 8, SIDE * 3 // 8)
            picture[:, :, slice(edge) if random.random() < 0.5 else slice(SIDE - edge, SIDE)] = 0


def cut_some_limbs(x, joints, random):
    """As the segmenter does: what is around an elbow, a wrist, a knee or an ankle is taken for something else, or not
    for the person's alone."""
    rows, columns = torch.meshgrid(torch.arange(SIDE).float(), torch.arange(SIDE).float(), indexing="ij")
    for picture, places in zip(x, joints):
        if random.random() < 0.3:
            joint = places[random.choice(LIMB_ENDS)]
            radius_px = random.uniform(5, 18)
            cut = (columns - joint[U]) ** 2 + (rows - joint[V]) ** 2 < radius_px ** 2
            cut = (cut & (picture[OWN] > 0)).float()
            picture[OTHER_DEPTH] += cut * picture[DEPTH]
            picture[OTHER] += torch.where(picture[DEPTH] < 0, -cut, cut)
            picture[:2] *= 1 - cut


def joints_in_sight(joints, lost):
    """Joints in pixels that were lost (shape (pictures, rows, columns), 1 where they were) are hidden ones."""
    column, row = (joints[:, :, k].round().long().clamp(0, SIDE - 1) for k in (U, V))
    joints = joints.clone()
    joints[:, :, VISIBLE] *= 1 - lost[torch.arange(len(joints))[:, None], row, column]
    return joints


def lose_some_edges(x, random):
    """As real depth cameras do: round a silhouette nothing is measured for up to four pixels, on one side up to three
    more, and in a third of these batches a pixel of the body is lost too."""
    some = torch.from_numpy(random.random(len(x)) < 0.3)
    if not some.any():
        return
    own, depth, other = x[some, :1], x[some, 1:2], x[some, 2:]
    width_px = int(random.integers(1, 5))
    lost = F.max_pool2d(own, 2 * width_px + 1, 1, width_px)
    lost = torch.maximum(lost, lost.roll(int(random.integers(-3, 4)), 3))
    kept = -F.max_pool2d(-own, 3, 1, 1) if random.random() < 0.33 else own
    x[some] = torch.cat([kept, depth * kept, other * (1 - lost)], 1)


def smear_some(x, random):
    """As depth cameras do that smooth and fill: depths averaged, silhouettes up to four pixels wider."""
    some = torch.from_numpy(random.random(len(x)) < 0.2)
    if not some.any():
        return
    own, depth, other = x[some, :1], x[some, 1:2], x[some, 2:]
    for _ in range(int(random.integers(1, 5))):
        around = F.avg_pool2d(own, 3, 1, 1)
        mean = F.avg_pool2d(depth * own, 3, 1, 1) / around.clamp(min=1e-6)
        depth = torch.where(own > 0, 0.5 * (depth + mean), torch.where(around > 0, mean, torch.zeros_like(depth)))
        own = (around > 0).float()
    x[some] = torch.cat([own, depth, other * (1 - own)], 1)


def rings_of(random):
    """First and last row + 1 of what each ring of a scanner sees: 3 to 12 px."""
    height_px = random.uniform(3, 12)
    edges = np.arange(-random.uniform(0, height_px), SIDE + height_px, height_px).round().clip(0, SIDE).astype(int)
    return [(first, end) for first, end in zip(edges, edges[1:]) if first < end]


def shift_some_rings(x, has_rings, random):
    """As of scanners whose lasers are not all calibrated alike: in a half of the pictures each ring's columns and depths
    are off by up to 2 px and 2 cm (standard deviations), and up to 4 % of the rings see nothing."""
    for k in np.flatnonzero(has_rings & (random.random(len(x)) < 0.5)):
        columns_px, depths_m, lost_share = random.uniform(0, 2), random.uniform(0, 0.02), random.uniform(0, 0.04)
        for first, end in rings_of(random):
            ring = x[k:k + 1, :, first:end]
            ring[:] = ring.roll(round(random.normal(0, columns_px)), 3)
            behind_m = random.normal(0, depths_m)
            change_depths(ring, lambda depths: depths + behind_m / PICTURE_UNIT_M)
            if random.random() < lost_share:
                ring[:] = 0


def varied(x, joints, random, has_rings=None):
    """`has_rings`: of each picture; of scans alone."""
    x, joints = mirror_some(x, joints, random)
    x, joints = move(x, joints, random, scans=has_rings is not None)
    add_noise(x, random)
    if has_rings is not None:
        shift_some_rings(x, has_rings, random)
    own = x[:, 0].clone()
    hide_parts(x, random)
    joints = joints_in_sight(joints, own - x[:, 0])
    cut_some_limbs(x, joints, random)
    lose_some_edges(x, random)
    smear_some(x, random)
    return x, joints


def figures_of(output):
    """What cells tell: PRESENCE, OFFSET_U ... of all joints."""
    return [output[:, k * JOINTS:(k + 1) * JOINTS] for k in range(5)]


def person_odds(output):
    return output[:, PERSON].mean((1, 2))


def loss_of(output, joints, is_person):
    presence, offset_u, offset_v, depth, sight = figures_of(output)
    rows, columns = torch.meshgrid(torch.arange(CELLS).float(), torch.arange(CELLS).float(), indexing="ij")
    du = ((joints[:, :, U] + 0.5) / CELL - 0.5)[:, :, None, None] - columns
    dv = ((joints[:, :, V] + 0.5) / CELL - 0.5)[:, :, None, None] - rows
    told = (joints[:, :, TOLD] > 0)[:, :, None, None].float()
    wanted = torch.exp(-(du ** 2 + dv ** 2) / 2.0) * told
    # A hidden joint is half a guess.
    weight = ((0.4 + 0.6 * joints[:, :, VISIBLE]) * is_person[:, None])[:, :, None, None]
    surprise = F.binary_cross_entropy_with_logits(presence, wanted, reduction="none") - F.binary_cross_entropy(
        wanted, wanted, reduction="none")
    places = (weight * surprise * (1 + 4 * wanted)).sum((2, 3)).mean(1).sum() / (is_person.sum() + 1)
    near = (wanted > 0.25).float()
    count = (near * weight).sum() + 1

    def off(figures, truth):
        return (near * weight * F.smooth_l1_loss(figures, truth.expand_as(figures), reduction="none",
                                                 beta=0.3)).sum() / count

    depths = (joints[:, :, BEHIND_M] / DEPTH_UNIT_M)[:, :, None, None]
    visible = joints[:, :, VISIBLE][:, :, None, None].expand_as(sight)
    sights = (near * F.binary_cross_entropy_with_logits(sight, visible, reduction="none")).sum() / count
    persons = F.binary_cross_entropy_with_logits(person_odds(output), is_person)
    return 0.5 * places + off(offset_u, du) + off(offset_v, dv) + off(depth, depths) + 0.3 * sights + persons


def has_brain_floats():
    with open("/proc/cpuinfo", encoding="ascii") as file:
        flags = file.read()
    return "amx_bf16" in flags or "avx512_bf16" in flags


def computed(network, x):
    with torch.cpu.amp.autocast(enabled=BRAIN_FLOATS, dtype=torch.bfloat16):
        return network(x.contiguous(memory_format=torch.channels_last)).float()


def marks_of(output):
    """Column and row of each joint, and how far behind the middle [m], as the surest cell tells."""
    presence, offset_u, offset_v, depth, _ = (figures.flatten(2) for figures in figures_of(output))
    cell = presence.argmax(2, keepdim=True)
    at_cell = lambda figures: figures.gather(2, cell)[:, :, 0]
    u = (cell % CELLS)[:, :, 0] + at_cell(offset_u)
    v = (cell // CELLS)[:, :, 0] + at_cell(offset_v)
    return (u + 0.5) * CELL - 0.5, (v + 0.5) * CELL - 0.5, at_cell(depth) * DEPTH_UNIT_M


def seen_in(network, x):
    """The mean of what the network tells of pictures and of their mirror images, as depth_pose.cpp takes it."""
    mirror = network(x.flip(3)).flip(3)
    figures = [of_joints[:, MIRRORED] for of_joints in figures_of(mirror)]
    figures[OFFSET_U] = -figures[OFFSET_U]
    return 0.5 * (network(x) + torch.cat([*figures, mirror[:, PERSON:]], 1))


def check(network, path):
    """Prints the share of visible limbs' joints within 10 cm across the ray, whose sides are exchanged, and how many
    people and things are taken for people."""
    records = np.fromfile(path, RECORD)
    network.eval()
    outputs = []
    with torch.no_grad():
        for start in range(0, len(records), BATCH):
            outputs.append(seen_in(network, tensors_of(records[start:start + BATCH])[0]))
    network.train()
    u, v, behind_m = marks_of(torch.cat(outputs))
    taken = (person_odds(torch.cat(outputs)) > 0).numpy()
    is_person = records["is_person"] > 0
    joints, scale = tensors_of(records)[1], torch.from_numpy(records["px_per_m"].copy())[:, None]
    visible = (joints[:, :, VISIBLE] > 0) & (joints[:, :, TOLD] > 0)
    visible[:, :4] = False

    def errors_m(order):
        return torch.hypot(u[:, order] - joints[:, :, U], v[:, order] - joints[:, :, V]) / scale

    as_told, exchanged = errors_m(list(range(JOINTS))), errors_m(MIRRORED)
    capped = lambda errors: (errors.clamp(max=0.3) * visible).sum(1)
    depth_m = (behind_m - joints[:, :, BEHIND_M]).abs()[visible].median()
    print(f"  {os.path.basename(path)}: {(as_told[visible] < 0.1).float().mean() * 100:.1f} % within 10 cm, "
          f"sides exchanged {int((capped(as_told) > capped(exchanged)).sum())}, depth off by {depth_m * 100:.1f} cm, "
          f"taken for people {taken[is_person].sum()} of {is_person.sum()} people and {taken[~is_person].sum()} of "
          f"{(~is_person).sum()} things", flush=True)


BRAIN_FLOATS = has_brain_floats()  # elsewhere they are slow


def pictures_of_epoch(is_person, random):
    """All people and a half of the things, of which there are as many and which tell less."""
    things = random.permutation(np.flatnonzero(is_person == 0))
    return random.permutation(np.concatenate([np.flatnonzero(is_person), things[: len(things) // 2]]))


def train_cycle(network, records, checks, epochs, rate, random, has_rings=None):
    optimizer = torch.optim.AdamW(network.parameters(), rate, weight_decay=1e-4)
    steps = epochs * (len(pictures_of_epoch(records["is_person"], random)) // BATCH)
    schedule = torch.optim.lr_scheduler.OneCycleLR(optimizer, rate, total_steps=steps + 1, pct_start=0.15)
    started = time.time()
    for epoch in range(epochs):
        order, losses = pictures_of_epoch(records["is_person"], random), []
        for start in range(0, len(order) - BATCH + 1, BATCH):
            batch = np.sort(order[start:start + BATCH])
            x, joints, is_person = tensors_of(records[batch])
            x, joints = varied(x, joints, random, None if has_rings is None else has_rings[batch])
            optimizer.zero_grad()
            loss = loss_of(computed(network, x), joints, is_person)
            loss.backward()
            optimizer.step()
            schedule.step()
            losses.append(loss.item())
        print(f"epoch {epoch + 1} of {epochs}: loss {np.mean(losses):.3f}, {time.time() - started:.0f} s", flush=True)
        if (epoch + 1) % 3 == 0 or epoch + 1 == epochs:
            for path in checks:
                check(network, path)


def train(network, records, checks, cycles, has_rings=None):
    print(f"{len(records)} pictures", flush=True)
    random = np.random.default_rng(1)
    network.train()
    for epochs, rate in cycles:
        train_cycle(network, records, checks, epochs, rate, random, has_rings)
    return network.eval()


def train_on_bent(network, bent, usual, checks):
    chosen = np.random.default_rng(2).permutation(len(usual))[:int(USUAL_FOR_EACH_BENT * len(bent))]
    return train(network, np.concatenate([bent, usual[np.sort(chosen)]]), checks, BENT_CYCLES)


def train_on_scans(network, rings, rasters, checks):
    of_rings, of_rasters = (read_records(paths, MOST_THINGS) for paths in (rings, rasters))
    has_rings = np.repeat([True, False], [len(of_rings), len(of_rasters)])
    return train(network, np.concatenate([of_rings, of_rasters]), checks, SCAN_CYCLES, has_rings)


# Writing


def folded(conv, norm=None):
    """Weights (outputs, rows, columns, inputs) and biases of a convolution with its normalisation."""
    weights, bias = conv.weight.detach(), conv.bias.detach()
    if norm is not None:
        scale = norm.weight.detach() / torch.sqrt(norm.running_var + norm.eps)
        weights = weights * scale[:, None, None, None]
        bias = (bias - norm.running_mean) * scale + norm.bias.detach()
    return weights.permute(0, 2, 3, 1).numpy(), bias.numpy()


class Graph(tflite_writer.Graph):
    def step(self, kind, inputs, shape, options, name=None):
        output = self.tensor(name or f"step{len(self.steps)}", shape)
        self.steps.append((kind, inputs, output, options))
        return output

    def convolution(self, source, conv, norm=None, activation=0, name=None):
        weights, bias = folded(conv, norm)
        stride = conv.stride[0]
        _, rows, columns, _ = self.shape(source)
        number = len(self.steps)
        inputs = [source, self.constant(f"weights{number}", weights), self.constant(f"bias{number}", bias)]
        return self.step(CONVOLUTION, inputs, (1, rows // stride, columns // stride, len(bias)),
                         {"same": True, "stride": stride, "activation": activation}, name)

    def sum(self, first, second, activation=0):
        return self.step(ADD, [first, second], self.shape(first), {"activation": activation})

    def stage(self, source, stage):
        x = self.convolution(source, stage.smaller, stage.norm, RELU)
        for first, first_norm, _, second, second_norm in stage.blocks:
            change = self.convolution(self.convolution(x, first, first_norm, RELU), second, second_norm)
            x = self.sum(x, change, RELU)
        return x

    def joined(self, coarse, fine, joined):
        narrow = self.convolution(coarse, joined.narrow)
        twice = self.step(RESIZE, [narrow], self.shape(fine), {})
        return self.convolution(self.sum(fine, twice), joined.conv, joined.norm, RELU)


def write(network, path):
    graph = Graph("picture", (1, SIDE, SIDE, CHANNELS_SEEN))
    seen, x = [], 0
    for stage in network.stages:
        x = graph.stage(x, stage)
        seen.append(x)
    for joined, fine in zip(network.joined, (seen[2], seen[1])):
        x = graph.joined(x, fine, joined)
    joints = graph.convolution(x, network.out, name="joints")
    tflite_writer.write(graph, [joints], "limbcast DepthPose", path)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out")
    parser.add_argument("scans_out")
    parser.add_argument("bent_out")
    parser.add_argument("training", nargs="+")
    parser.add_argument("--rings", nargs="+", required=True)
    parser.add_argument("--rasters", nargs="+", required=True)
    parser.add_argument("--bent", nargs="+", required=True)
    parser.add_argument("--check", nargs="*", default=[])
    arguments = parser.parse_args()
    torch.manual_seed(1)
    torch.set_num_threads(os.cpu_count())
    network = DepthPose().to(memory_format=torch.channels_last)
    usual = read_records(arguments.training)
    write(train(network, usual, arguments.check, CYCLES), arguments.out)
    bent = train_on_bent(copy.deepcopy(network), read_records(arguments.bent), usual, arguments.check)
    write(bent, arguments.bent_out)
    write(train_on_scans(network, arguments.rings, arguments.rasters, arguments.check), arguments.scans_out)


if __name__ == "__main__":
    main()
