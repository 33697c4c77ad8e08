// A block of soil behind a wall, under a surcharge; its top runs through the middle of cells.
cell = 0.125;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1 + cell/2};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("back") = {2};
Physical Curve("surcharge") = {3};
