// A block of sand with a bay cut out of one side. Lengths in metres.
SetFactory("OpenCASCADE");
length = 0.24;
width  = 0.16;
height = 0.12;
radius = 0.06;
Box(1) = {0, 0, 0, length, width, height};
Cylinder(2) = {length/2, 0, 0, 0, 0, height, radius};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Physical Volume("sand") = {3};
