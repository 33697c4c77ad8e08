// A disc of radius 0.5 m, one cell above the plane y = 0: it is carried before its particles are on the plane.
SetFactory("OpenCASCADE");
gap = 0.0625;
Disk(1) = {1, 0.5 + gap, 0, 0.5};
Physical Surface("soil") = {1};
