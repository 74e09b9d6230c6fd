// In a folder of the project npm would pack what lies there, without core, page and notices.
process.stderr.write("npm pack: the packages are made by npm run pack, in the project's folder.\n");
process.exitCode = 1;
