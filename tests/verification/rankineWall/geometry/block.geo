// A block of soil behind a face, under a surcharge. Its loaded sides run through the middle of cells.
cell = 0.1333333333333333;
height = 1;
width = 2 + cell / 2;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, height};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("face") = {2};
Physical Curve("surcharge") = {3};
Physical Curve("back") = {4};
