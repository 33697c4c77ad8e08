// A block, and where it lies.
SetFactory("OpenCASCADE");
x0 = 0;
Rectangle(1) = {x0, 0, 0, 2, 3};
Physical Surface("soil") = {1};
