// A quarter of a cylinder of sand. Lengths in metres. report.py changes the height.
SetFactory("OpenCASCADE");
radius = 0.1;
height = 0.1;
Cylinder(1) = {0, 0, 0, 0, 0, height, radius, Pi/2};
Physical Volume("sand") = {1};
