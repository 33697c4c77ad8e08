// A column 8 m high; check.py makes it 4 m wide where its sides are free.
width = 0.25;
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, width, 8};
Physical Surface("soil") = {1};
Physical Curve("base") = {1};
Physical Curve("right") = {2};
Physical Curve("left") = {4};
