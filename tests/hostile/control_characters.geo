// must not: prints escape sequences
//@SQUARE@
Printf("[31mred ]0;title 2J");
Error("[2J]8;;http://evilclick]8;;");
