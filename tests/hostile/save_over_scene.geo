// must not: writes over its scene
//@SQUARE@
Mesh 2;
Save "@SCENE@/scene.json";
