// Half of a strip load of width 2 m (B/2 = 1 m) on a layer; x = 0 is the plane of symmetry.
Point(1) = {0, 0, 0};
Point(2) = {5, 0, 0};
Point(3) = {5, 2.5, 0};
Point(4) = {1, 2.5, 0};
Point(5) = {0, 2.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Physical Surface("soil") = {1};
Physical Curve("strip") = {4};
