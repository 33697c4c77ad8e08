// Half of a layer of clay under a strip footing; x = 0 is the plane of symmetry. Lengths in metres.
SetFactory("OpenCASCADE");
width = 40;
depth = 20;
Rectangle(1) = {0, 0, 0, width, depth};
Physical Surface("clay") = {1};
Physical Curve("base") = {1};
Physical Curve("side") = {2};
Physical Curve("middle") = {4};
