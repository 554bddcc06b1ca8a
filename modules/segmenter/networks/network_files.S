// The networks' files, by the labels that ../faces_and_joints knows (blaze_face.cpp, blaze_pose.cpp, depth_pose.cpp, move_net.cpp).
    .section .rodata
    .global limbcast_blaze_face
    .balign 16
limbcast_blaze_face:
    .incbin LIMBCAST_BLAZE_FACE
    .global limbcast_blaze_pose
    .balign 16
limbcast_blaze_pose:
    .incbin LIMBCAST_BLAZE_POSE
    .global limbcast_depth_pose
    .balign 16
limbcast_depth_pose:
    .incbin LIMBCAST_DEPTH_POSE
    .global limbcast_scan_depth_pose
    .balign 16
limbcast_scan_depth_pose:
    .incbin LIMBCAST_SCAN_DEPTH_POSE
    .global limbcast_bent_depth_pose
    .balign 16
limbcast_bent_depth_pose:
    .incbin LIMBCAST_BENT_DEPTH_POSE
    .global limbcast_move_net
    .balign 16
limbcast_move_net:
    .incbin LIMBCAST_MOVE_NET
// Linux: what is here needs no stack that can be executed.
    .section .note.GNU-stack,"",%progbits
