// The pose network's file, by the label that pose_network.cpp knows.
    .section .rodata
    .global limbcast_pose_network
    .balign 16
limbcast_pose_network:
    .incbin LIMBCAST_POSE_NETWORK
// Linux: what is here needs no stack that can be executed.
    .section .note.GNU-stack,"",%progbits
