// The pose network's file, between two labels that pose_network.cpp knows.
    .section .rodata
    .global limbcast_pose_network_begin
    .global limbcast_pose_network_end
    .balign 16
limbcast_pose_network_begin:
    .incbin LIMBCAST_POSE_NETWORK
limbcast_pose_network_end:
// Linux: what is here needs no stack that can be executed.
    .section .note.GNU-stack,"",%progbits
