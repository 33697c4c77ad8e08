// A disc of radius 0.5 m, over the plane y = 0 by what a grid of 1/16 m feels contact early.
SetFactory("OpenCASCADE");
gap = 0.65 * 0.0625;
Disk(1) = {1, 0.5 + gap, 0, 0.5};
Physical Surface("soil") = {1};
