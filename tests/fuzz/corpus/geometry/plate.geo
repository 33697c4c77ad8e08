Point(1) = {0, 0, 0}; Point(2) = {4, 0, 0}; Point(3) = {4, 3, 0}; Point(4) = {0, 3, 0};
Point(5) = {1, 1, 0}; Point(6) = {2, 1, 0}; Point(7) = {2, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7}; Plane Surface(1) = {1, 2};
Physical Surface("soil") = {1}; Physical Curve("base") = {1};
