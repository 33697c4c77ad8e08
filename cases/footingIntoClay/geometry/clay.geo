// Half of a layer of clay under a strip footing; x = 0 is the plane of symmetry. Lengths in metres.
SetFactory("OpenCASCADE");
width = 4;
depth = 2;
Rectangle(1) = {0, 0, 0, width, depth};
Physical Surface("clay") = {1};
Physical Curve("base") = {1};
Physical Curve("side") = {2};
Physical Curve("middle") = {4};
