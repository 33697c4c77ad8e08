// A column of soil on a rough floor.
SetFactory("OpenCASCADE");
Rectangle(1) = {2, 0, 0, 1, 2};
Physical Surface("soil") = {1};
