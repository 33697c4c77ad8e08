SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1};
Physical Surface("block") = {1};
Physical Curve("below") = {1};
Physical Curve("right") = {2};
Physical Curve("above") = {3};
Physical Curve("left") = {4};
