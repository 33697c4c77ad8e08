SystemCall "touch broken";
Printf("x") > "broken";
Save "broken.msh";
