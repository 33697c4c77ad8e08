// Two discs of radius 0.2 m; `aside` moves the second off the diagonal.
aside = 0;
SetFactory("OpenCASCADE");
Disk(1) = {0.2, 0.2, 0, 0.2};
Disk(2) = {0.8 + aside, 0.8 - aside, 0, 0.2};
Physical Surface("left") = {1};
Physical Surface("right") = {2};
