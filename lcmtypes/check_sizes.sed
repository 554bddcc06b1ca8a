# lcm-gen 1.3.1 makes room for what a message claims before it looks whether its bytes are there: a forged calibration of
# 300 bytes took 17 GB and a minute, and a text of -2147483648 bytes ended the process. No element takes less than a
# sixteenth of the memory's bytes in a message: the least is 4 bytes for the number of an empty vector's elements.

# C++
s/^( *)this->([a-z_]+)\.resize\((this->[a-z_]+)\);/\1if(\3 < 0 || \3 > (maxlen - pos) \/ (int)(sizeof(this->\2[0]) \/ 16 + 1)) return -1;\n&/
s/^( *)if\((__[a-z_]+_len__) > maxlen - pos\) return -1;/\1if(\2 < 1 || \2 > maxlen - pos) return -1;/

# Java
s/^( *)this\.[a-z_]+ = new [a-z_.]+\[\(int\) ([a-z_]+)\];/\1if(\2 < 0 || ins instanceof LCMDataInputStream \&\& \2 > ((LCMDataInputStream) ins).available()) throw new EOFException("claims " + \2 + " elements");\n&/
s/__strbuf = new char\[ins\.readInt\(\)-1\];/{ int length = ins.readInt(); if(length < 1 || ins instanceof LCMDataInputStream \&\& length > ((LCMDataInputStream) ins).available()) throw new EOFException("claims a text of " + length + " bytes"); __strbuf = new char[length-1]; }/
