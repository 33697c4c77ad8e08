// A disc on a plane, seen in the plane's frame: x runs down the slope. Lengths in metres.
radius = 0.5;
length = 3;
depth = 0.25;
start = 0.75;
SetFactory("OpenCASCADE");
Disk(1) = {start, radius, 0, radius};
Rectangle(2) = {0, -depth, 0, length, depth};
Physical Surface("disc") = {1};
Physical Surface("plane") = {2};
