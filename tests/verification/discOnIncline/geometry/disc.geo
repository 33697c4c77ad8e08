// A disc of radius 0.5 m, over the plane y = 0 by what a grid of this cell size feels contact early.
cell = 0.0416666666666667;
SetFactory("OpenCASCADE");
Disk(1) = {1, 0.5 + 0.65 * cell, 0, 0.5};
Physical Surface("disc") = {1};
