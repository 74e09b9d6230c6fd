import { createApp } from "vue";
import "ol/ol.css";
import CloudMap from "./cloud-map.vue";

const url = new URLSearchParams(location.search).get("cloud");
createApp(CloudMap, { url, color: "elevation" }).mount("#app");
