// A block of soil without cohesion.
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1.5, 1.5, 2};
Physical Volume("soil") = {1};
