// A layer of sand between two walls. Lengths in metres.
SetFactory("OpenCASCADE");
length = 3;
height = 1;
Rectangle(1) = {0, 0, 0, length, height};
Physical Surface("sand") = {1};
Physical Curve("base") = {1};
Physical Curve("end") = {2};
Physical Curve("wall") = {4};
