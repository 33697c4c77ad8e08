// One period of the bar: its odd extension makes it two lengths long. 1/32 m thick, one of the largest cells. Metres.
Point(1) = {0, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 0.03125, 0};
Point(4) = {0, 0.03125, 0};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};

Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};

Physical Surface("bar") = {1};
Physical Curve("below") = {1};
Physical Curve("above") = {3};
