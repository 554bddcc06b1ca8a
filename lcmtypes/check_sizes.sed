# lcm-gen 1.3.1 makes room for as many elements as a message claims before it looks whether their bytes are there: a
# forged calibration of 300 bytes took 17 GB and a minute. Each element takes at least a byte.
s/^( *)this->[a-z_]+\.resize\((this->[a-z_]+)\);/\1if(\2 > maxlen - pos) return -1;\n&/
