// A free block of four by four cells.
SetFactory("OpenCASCADE");
Rectangle(1) = {3, 3, 0, 2, 2};
Physical Surface("soil") = {1};
