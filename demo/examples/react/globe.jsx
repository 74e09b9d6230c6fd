import { PointCloudLayer } from "@groma/layer/cesium";
import { CesiumWidget } from "cesium";
import { useEffect, useRef, useState } from "react";

/** A globe with a cloud: another `url` opens another cloud, another `style` draws the same one differently. */
export function Globe({ url, style }) {
  const container = useRef(null);
  const [widget, setWidget] = useState();
  const [layer, setLayer] = useState();
  const [message, setMessage] = useState("");

  useEffect(() => {
    const made = new CesiumWidget(container.current, { baseLayer: false });
    setWidget(made);
    return () => made.destroy();
  }, []);

  useEffect(() => {
    if (!widget || widget.isDestroyed()) return undefined;
    const controller = new AbortController();
    PointCloudLayer.fromUrl(url, { signal: controller.signal }).then(
      (opened) => {
        // A component that is gone lets go of what came too late.
        if (controller.signal.aborted) return opened.destroy();
        widget.scene.primitives.add(opened);
        widget.camera.viewBoundingSphere(opened.boundingSphere);
        opened.allNodesLoaded.addEventListener(() => setMessage(`${opened.statistics.pointsDrawn} points`));
        setLayer(opened);
      },
      (error) => controller.signal.aborted || setMessage(error.message),
    );
    return () => {
      controller.abort();
      setLayer((shown) => {
        // Removed from a scene, a layer is destroyed.
        if (shown && !widget.isDestroyed()) widget.scene.primitives.remove(shown);
        return undefined;
      });
    };
  }, [widget, url]);

  useEffect(() => {
    if (layer && !layer.isDestroyed()) layer.style = style;
  }, [layer, style]);

  return (
    <>
      <div ref={container} style={{ height: "90vh" }} />
      <output>{message}</output>
    </>
  );
}
